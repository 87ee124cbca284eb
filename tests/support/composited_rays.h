#pragma once
// Rays before and after a kernel, to compare it with its definition.

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "renderer/shear/kernel.h"

namespace shearwater::test {

struct CompositedRays {
    std::vector<float> r, g, b, a;
    std::uint64_t taken;  // samples
};

// What becomes of so many rays, `stride` from row to row, that have gathered this or that before; some are
// done: those with all opacity, and those with more than `done`, if any. composite(rays) returns the samples
// it took.
template <class Composite>
CompositedRays composited_rays(std::size_t count, std::ptrdiff_t stride, const Composite& composite,
                               float done = view::opaque_enough) {
    std::mt19937 start(7);
    CompositedRays rays{std::vector<float>(count), std::vector<float>(count), std::vector<float>(count),
                        std::vector<float>(count), 0};
    for (std::size_t n = 0; n < count; ++n) {
        rays.a[n] = start() % 5 == 4 ? 1 : 0.1F * static_cast<float>(start() % 4);
        rays.g[n] = 0.5F * rays.a[n];
    }
    rays.taken = composite(shear::Rays{.r = rays.r.data(),
                                       .g = rays.g.data(),
                                       .b = rays.b.data(),
                                       .a = rays.a.data(),
                                       .stride = stride,
                                       .done = done});
    return rays;
}

}  // namespace shearwater::test
