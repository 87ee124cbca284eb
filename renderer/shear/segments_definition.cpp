#include <algorithm>
#include <cmath>

#include "renderer/shear/segments.h"

namespace shearwater::shear {

namespace {

// An integral's difference between two nodes.
float between(float from, float from_rest, float to, float to_rest) {
    return (to - from) + (to_rest - from_rest);
}

// Puts a segment between two nodes behind a ray.
void composite(int front, int back, const SegmentTable& table, float length, float& r, float& g, float& b,
               float& a) {
    const bool alike = front == back;
    const SegmentTable::Node& from = table.nodes()[alike ? front - 1 : front];
    const SegmentTable::Node& to = table.nodes()[alike ? back + 1 : back];
    const auto nodes = static_cast<float>(&to - &from);
    const float integral = between(from.depth, from.depth_rest, to.depth, to.depth_rest);
    const float depth = std::max(integral / nodes, 0.0F) * length;
    if (!(depth > 0)) {
        return;
    }
    const float weight = (1 - a) * -std::expm1(-depth * 0.69314718F);
    r += weight * between(from.r, from.r_rest, to.r, to.r_rest) / integral;
    g += weight * between(from.g, from.g_rest, to.g, to.g_rest) / integral;
    b += weight * between(from.b, from.b_rest, to.b, to.b_rest) / integral;
    a += weight;
}

template <class Code>
void composite_ray(const SegmentSlab<Code>& slab, const SegmentTable& table, const Rays& rays, int i, int j,
                   std::uint64_t& taken) {
    const std::ptrdiff_t n = j * rays.stride + i;
    if (rays.a[n] >= rays.done) {
        return;
    }
    for (int k = 0; k < slab.count; ++k) {
        const Segment& segment = slab.segments[static_cast<std::size_t>(k)];
        const view::Rect& pixels = segment.pixels;
        if (i < pixels.x0 || i >= pixels.x1 || j < pixels.y0 || j >= pixels.y1) {
            continue;
        }
        ++taken;
        const auto code_at = [&](int slice) {
            return sample_by_definition(slab.samples, slab.samples.slices[static_cast<std::size_t>(slice)], i,
                                        j);
        };
        const float front = code_at(segment.front);
        const float back = code_at(segment.back);
        if (front > 0 || back > 0) {
            const float length = (front > 0 && back > 0 ? 1 : 0.5F) * segment.lengths[n];
            composite(table.node_of(front > 0 ? front : back), table.node_of(back > 0 ? back : front), table,
                      length, rays.r[n], rays.g[n], rays.b[n], rays.a[n]);
        }
    }
}

}  // namespace

template <class Code>
std::uint64_t composite_segments_by_definition(const SegmentSlab<Code>& slab, const SegmentTable& table,
                                               const Rays& rays) {
    view::Rect pixels;
    for (int k = 0; k < slab.count; ++k) {
        pixels = view::bounding(pixels, slab.segments[static_cast<std::size_t>(k)].pixels);
    }
    std::uint64_t taken = 0;
    for (int j = pixels.y0; j < pixels.y1; ++j) {
        for (int i = pixels.x0; i < pixels.x1; ++i) {
            composite_ray(slab, table, rays, i, j, taken);
        }
    }
    return taken;
}

template std::uint64_t composite_segments_by_definition(const SegmentSlab<std::uint8_t>&, const SegmentTable&,
                                                        const Rays&);
template std::uint64_t composite_segments_by_definition(const SegmentSlab<std::uint16_t>&,
                                                        const SegmentTable&, const Rays&);

}  // namespace shearwater::shear
