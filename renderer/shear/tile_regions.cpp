// Which voxels a tile needs: for some slices, for those that come next.

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/shear/tile.h"

namespace shearwater::shear {

using view::Rect;
using view::SliceMap;

namespace {

// The coordinates that the first and the last of some pixels lie at, the lesser first.
std::pair<double, double> ends_of(double offset, double scale, int first, int end) {
    const double a = offset + scale * first;
    const double b = offset + scale * (end - 1);
    return {std::min(a, b), std::max(a, b)};
}

// std::floor, for what has an integer: some processors that this has to run on have no instruction for it.
std::int64_t floor_of(double x) {
    const auto towards_zero = static_cast<std::int64_t>(x);
    return towards_zero - (x < static_cast<double>(towards_zero) ? 1 : 0);
}

}  // namespace

// All nodes of a box.
template <class Code>
VoxelRegion Tile<Code>::nodes_of(const volume::Box& box) const {
    const std::array<int, 3> axes{plan_.fast_axis(), plan_.slow_axis(), plan_.face().axis};
    VoxelRegion region;
    for (std::size_t n = 0; n < axes.size(); ++n) {
        region.lo[n] = box.lo[static_cast<std::size_t>(axes[n])];
        region.hi[n] = box.hi[static_cast<std::size_t>(axes[n])];
    }
    return region;
}

// The voxels that the samples of some slices lie between, of those `within`.
template <class Code>
VoxelRegion Tile<Code>::region_of(Slices slices, std::span<const std::int64_t> numbers,
                                  const VoxelRegion& within) const {
    std::array<std::pair<double, double>, 3> ends;
    ends.fill({1e300, -1e300});
    const auto add = [](std::pair<double, double>& to, const std::pair<double, double>& more) {
        to = {std::min(to.first, more.first), std::max(to.second, more.second)};
    };
    for (std::size_t n = 0; n < slices.size(); ++n) {
        const Slice<Code>& slice = slices[n];
        const Rect& pixels = slice.pixels;
        add(ends[0],
            ends_of(slice.fast_offset, slice.fast_scale, pixels.x0 + rect_.x0, pixels.x1 + rect_.x0));
        add(ends[1],
            ends_of(slice.slow_offset, slice.slow_scale, pixels.y0 + rect_.y0, pixels.y1 + rect_.y0));
        const double w = plan_.node_place(numbers[n]);
        add(ends[2], {w, w});
    }
    VoxelRegion region;
    for (std::size_t n = 0; n < 3; ++n) {
        const std::int64_t lo = within.lo[n], hi = within.hi[n];
        region.lo[n] = std::clamp(floor_of(ends[n].first), lo, hi - 1);
        region.hi[n] = std::clamp(floor_of(ends[n].second) + 1, lo + 1, hi);
    }
    // A slice on a plane needs none behind it.
    region.hi[2] =
        std::clamp(static_cast<std::int64_t>(std::ceil(ends[2].second)), region.lo[2], within.hi[2]);
    return region;
}

// The voxels of some octants on the planes of some slices, in order.
template <class Code>
VoxelRegion Tile<Code>::region_of(const MicroRun& fast, const MicroRun& slow,
                                  std::span<const std::int64_t> numbers) const {
    const std::array<int, 2> axes{plan_.fast_axis(), plan_.slow_axis()};
    const auto [near, far] =
        std::minmax({plan_.node_place(numbers.front()), plan_.node_place(numbers.back())});
    VoxelRegion region{{0, 0, static_cast<std::int64_t>(near)},
                       {0, 0, static_cast<std::int64_t>(std::ceil(far))}};
    for (std::size_t n = 0; n < axes.size(); ++n) {
        const MicroRun& octants = n == 0 ? fast : slow;
        const auto a = static_cast<std::size_t>(axes[n]);
        const std::int64_t first = codes_.micro_bricks().first(axes[n]) * CodeVolume::micro_edge;
        region.lo[n] = std::max(first + octants.first * CodeVolume::octant_edge, codes_.own().lo[a]);
        region.hi[n] = std::min(first + octants.end * CodeVolume::octant_edge, codes_.own().hi[a]);
    }
    return region;
}

// What the tile's live pixels need of the planes lo to hi across the principal axis, both included.
template <class Code>
VoxelRegion Tile<Code>::between_planes(std::int64_t lo, std::int64_t hi) const {
    const std::array<int, 2> axes{plan_.fast_axis(), plan_.slow_axis()};
    std::array<std::pair<double, double>, 2> ends;
    ends.fill({1e300, -1e300});
    for (const std::int64_t w : {lo, hi}) {
        const SliceMap map = plan_.node_map(static_cast<double>(w));
        const auto add = [](std::pair<double, double>& to, const std::pair<double, double>& more) {
            to = {std::min(to.first, more.first), std::max(to.second, more.second)};
        };
        add(ends[0], ends_of(map.u_offset, map.u_scale, rect_.x0 + live_.x0, rect_.x0 + live_.x1));
        add(ends[1], ends_of(map.v_offset, map.v_scale, rect_.y0 + live_.y0, rect_.y0 + live_.y1));
    }
    VoxelRegion region{{0, 0, lo}, {0, 0, hi}};
    for (std::size_t n = 0; n < 2; ++n) {
        const auto first = static_cast<double>(nodes_.lo[static_cast<std::size_t>(axes[n])]);
        const auto last = static_cast<double>(nodes_.hi[static_cast<std::size_t>(axes[n])]);
        region.lo[n] = static_cast<std::int64_t>(std::clamp(std::floor(ends[n].first), first, last));
        region.hi[n] = static_cast<std::int64_t>(std::clamp(std::floor(ends[n].second) + 1, first, last));
    }
    return region;
}

// What the tile will need and may fetch meanwhile: of the planes behind a region's, as many again.
template <class Code>
VoxelRegion Tile<Code>::behind(const VoxelRegion& region) const {
    const auto axis = static_cast<std::size_t>(plan_.face().axis);
    const std::int64_t away = plan_.face().sign * CodeVolume::micro_edge;
    const auto plane = [&](std::int64_t w) { return std::clamp(w + away, nodes_.lo[axis], nodes_.hi[axis]); };
    return between_planes(plane(region.lo[2]), plane(region.hi[2]));
}

template VoxelRegion Tile<std::uint8_t>::nodes_of(const volume::Box&) const;
template VoxelRegion Tile<std::uint8_t>::region_of(Slices, std::span<const std::int64_t>,
                                                   const VoxelRegion&) const;
template VoxelRegion Tile<std::uint8_t>::region_of(const MicroRun&, const MicroRun&,
                                                   std::span<const std::int64_t>) const;
template VoxelRegion Tile<std::uint8_t>::between_planes(std::int64_t, std::int64_t) const;
template VoxelRegion Tile<std::uint8_t>::behind(const VoxelRegion&) const;
template VoxelRegion Tile<std::uint16_t>::nodes_of(const volume::Box&) const;
template VoxelRegion Tile<std::uint16_t>::region_of(Slices, std::span<const std::int64_t>,
                                                    const VoxelRegion&) const;
template VoxelRegion Tile<std::uint16_t>::region_of(const MicroRun&, const MicroRun&,
                                                    std::span<const std::int64_t>) const;
template VoxelRegion Tile<std::uint16_t>::between_planes(std::int64_t, std::int64_t) const;
template VoxelRegion Tile<std::uint16_t>::behind(const VoxelRegion&) const;

}  // namespace shearwater::shear
