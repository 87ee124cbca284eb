#include <algorithm>
#include <cmath>

#include "renderer/shear/kernel.h"

namespace shearwater::shear {

namespace {

// Where a coordinate lies among the voxels of a slab.
struct Place {
    std::int64_t cell;
    float fraction;
};

Place place_among(double at, std::int64_t first_voxel, std::int64_t cells) {
    const std::int64_t steps = static_cast<std::int64_t>(at * cell_steps + 0.5) - first_voxel * cell_steps;
    // A sample on the last voxel of all belongs to the last cell.
    const std::int64_t cell = std::min(steps / cell_steps, cells - 1);
    return {cell, static_cast<float>(steps - cell * cell_steps) / cell_steps};
}

// The mean of the valid corners about a sample, or 0 where they weigh less than one half.
template <class Code>
float interpolate(const Slab<Code>& slab, const Slice<Code>& slice, const Place& fast, const Place& slow) {
    float sum = 0, valid = 0;
    for (const Code* const plane : {slice.voxels, slice.next}) {
        if (plane == nullptr) {
            continue;
        }
        const float plane_weight = slice.next == nullptr ? 1 : 0.5F;
        for (int corner = 0; corner < 4; ++corner) {
            const int du = corner % 2;
            const int dv = corner / 2;
            const Code code = plane[(slow.cell + dv) * slab.stride + fast.cell + du];
            const float weight = plane_weight * (du == 1 ? fast.fraction : 1 - fast.fraction) *
                                 (dv == 1 ? slow.fraction : 1 - slow.fraction);
            sum += weight * static_cast<float>(code);
            valid += code == 0 ? 0 : weight;
        }
    }
    return !slab.blanks ? sum : valid < least_valid ? 0 : sum / valid;
}

// Puts a sample behind a ray.
void composite(float code, const OpacityTable& table, bool between_nodes, float length, float& r, float& g,
               float& b, float& a) {
    const float at = code * table.nodes_per_code();
    const int below = static_cast<int>(at);
    const OpacityTable::Node* const node = table.nodes() + below;
    const float fraction = at - static_cast<float>(below);
    const OpacityTable::Node& nearest = node[fraction < 0.5F ? 0 : 1];
    const float extinction = between_nodes
                                 ? node[0].extinction + fraction * (node[1].extinction - node[0].extinction)
                                 : nearest.extinction;
    const float alpha = -std::expm1(-extinction * length * 0.69314718F);
    const float weight = (1 - a) * alpha;
    r += weight * nearest.r;
    g += weight * nearest.g;
    b += weight * nearest.b;
    a += weight;
}

}  // namespace

template <class Code>
float sample_by_definition(const Slab<Code>& slab, const Slice<Code>& slice, int i, int j) {
    const Place fast = place_among(slice.fast_offset + slice.fast_scale * (i + slab.fast_pixel),
                                   slab.fast_first, slab.fast_cells);
    const Place slow = place_among(slice.slow_offset + slice.slow_scale * (j + slab.slow_pixel),
                                   slab.slow_first, slab.slow_cells);
    return interpolate(slab, slice, fast, slow);
}

template float sample_by_definition(const Slab<std::uint8_t>&, const Slice<std::uint8_t>&, int, int);
template float sample_by_definition(const Slab<std::uint16_t>&, const Slice<std::uint16_t>&, int, int);

namespace {

template <class Code>
void composite_ray(const Slab<Code>& slab, const OpacityTable& table, const Rays& rays, int i, int j,
                   std::uint64_t& taken) {
    const std::ptrdiff_t n = j * rays.stride + i;
    if (rays.a[n] >= rays.done) {
        return;
    }
    for (int k = 0; k < slab.count; ++k) {
        const Slice<Code>& slice = slab.slices[static_cast<std::size_t>(k)];
        const view::Rect& pixels = slice.pixels;
        if (i < pixels.x0 || i >= pixels.x1 || j < pixels.y0 || j >= pixels.y1) {
            continue;
        }
        ++taken;
        const float code = sample_by_definition(slab, slice, i, j);
        if (code > 0) {
            composite(code, table, slab.between_nodes, slice.lengths[n], rays.r[n], rays.g[n], rays.b[n],
                      rays.a[n]);
        }
    }
}

}  // namespace

template <class Code>
std::uint64_t composite_slab_by_definition(const Slab<Code>& slab, const OpacityTable& table,
                                           const Rays& rays) {
    view::Rect pixels;
    for (int k = 0; k < slab.count; ++k) {
        pixels = view::bounding(pixels, slab.slices[static_cast<std::size_t>(k)].pixels);
    }
    std::uint64_t taken = 0;
    for (int j = pixels.y0; j < pixels.y1; ++j) {
        for (int i = pixels.x0; i < pixels.x1; ++i) {
            composite_ray(slab, table, rays, i, j, taken);
        }
    }
    return taken;
}

template std::uint64_t composite_slab_by_definition(const Slab<std::uint8_t>&, const OpacityTable&,
                                                    const Rays&);
template std::uint64_t composite_slab_by_definition(const Slab<std::uint16_t>&, const OpacityTable&,
                                                    const Rays&);

}  // namespace shearwater::shear
