// Where voxels have to be turned: a tile's slices, a strip of voxels at a time.
//
// A line of the cache has the voxels of many planes, on which a tile's rays lie beside one another more and
// more. To turn all that a tile needs of the lines before its first sample is taken would not leave them in
// the second cache. So it is done a few rows of voxels at a time, in an order that is front to back along
// every ray: what was turned is used up, on all planes, when the next rows take its place.

#include <algorithm>

#include "renderer/shear/tile.h"

namespace shearwater::shear {

namespace {

constexpr std::int64_t planes_of_a_strip = 64;
// As many bytes of voxels either way.
template <class Code>
constexpr std::int64_t rows_of_a_strip = 48 / static_cast<std::int64_t>(sizeof(Code));
// Rays move on sideways: what is turned for so many planes is found for each of them.
constexpr std::int64_t planes_of_a_part = 16;

}  // namespace

template <class Code>
void Tile<Code>::render_by_strips() {
    const std::int64_t count = plan_.slice_count();
    const auto planes_of = [&](std::int64_t n) { return cell_of(plan_.slice(n)) / planes_of_a_strip; };
    for (std::int64_t first = 0, end = 0; first < count && !live_.empty(); first = end) {
        end = first + 1;
        while (end < count && planes_of(end) == planes_of(first)) {
            ++end;
        }
        find_strips(first, end);
        for (const Strip& strip : strips_) {
            strip_ = &strip;
            render_slices_between(first, end);
            if (begun_) {
                narrow_live();
            }
        }
        strip_ = nullptr;
    }
}

// Those of the face's slices [first, end).
template <class Code>
void Tile<Code>::find_strips(std::int64_t first, std::int64_t end) {
    const auto axis = static_cast<std::size_t>(plan_.face().axis);
    const auto plane_at = [&](std::int64_t n) {
        return std::clamp(static_cast<std::int64_t>(plan_.node_place(plan_.slice(n))), nodes_.lo[axis],
                          nodes_.hi[axis]);
    };
    const auto [near, far] = std::minmax({plane_at(first), plane_at(end - 1)});
    const VoxelRegion all = between_planes(near, std::min(far + 1, nodes_.hi[axis]));
    const MicroRun bricks = runs_of(all, CodeVolume::micro_edge)[1];
    constexpr std::int64_t step = rows_of_a_strip<Code> / CodeVolume::micro_edge;
    // What begins at a strip's border may end on a node beyond.
    const std::int64_t beyond = classification_.segments ? 1 : 0;
    const auto node_of = [&, of = codes_.micro_bricks().first(plan_.slow_axis())](std::int64_t brick) {
        return (of + brick) * CodeVolume::micro_edge;
    };
    strips_.clear();
    for (std::int64_t brick = bricks.first; brick < bricks.end; brick += step) {
        const std::int64_t behind = std::min(brick + step, bricks.end);
        const std::int64_t lo = node_of(brick), hi = node_of(behind);
        constexpr std::int64_t octants = CodeVolume::micro_edge / CodeVolume::octant_edge;
        strips_.push_back({.voxels = {.lo = static_cast<double>(lo),
                                      .hi = static_cast<double>(hi),
                                      .open_lo = brick == bricks.first,
                                      .open_hi = behind == bricks.end},
                           .first = std::clamp(lo - beyond, all.lo[1], all.hi[1]),
                           .last = std::clamp(hi + beyond, all.lo[1], all.hi[1]),
                           .distance = distance(plan_, codes_.micro_bricks(), plan_.slow_axis(),
                                                {brick * octants, behind * octants})});
    }
    std::ranges::stable_sort(strips_, {}, &Strip::distance);
}

// What is turned with a region, part by part along the principal axis.
template <class Code>
std::span<const VoxelRegion> Tile<Code>::turned_with(const VoxelRegion& region) {
    const auto axis = static_cast<std::size_t>(plan_.face().axis);
    // What begins in a part may end on a plane behind it.
    const std::int64_t last = planes_of_a_part - (classification_.segments || !plan_.on_planes() ? 0 : 1);
    const auto clamped = [&](std::int64_t w) { return std::clamp(w, nodes_.lo[axis], nodes_.hi[axis]); };
    const std::int64_t lo = region.lo[2] / planes_of_a_strip * planes_of_a_strip;
    turned_.clear();
    for (std::int64_t w = lo; w < lo + planes_of_a_strip; w += planes_of_a_part) {
        VoxelRegion part = between_planes(clamped(w), clamped(w + last));
        part.lo[1] = std::max(part.lo[1], strip_->first);
        part.hi[1] = std::min(part.hi[1], strip_->last);
        if (part.lo[1] <= part.hi[1]) {
            turned_.push_back(part);
        }
    }
    return turned_;
}

template void Tile<std::uint8_t>::render_by_strips();
template void Tile<std::uint8_t>::find_strips(std::int64_t, std::int64_t);
template std::span<const VoxelRegion> Tile<std::uint8_t>::turned_with(const VoxelRegion&);
template void Tile<std::uint16_t>::render_by_strips();
template void Tile<std::uint16_t>::find_strips(std::int64_t, std::int64_t);
template std::span<const VoxelRegion> Tile<std::uint16_t>::turned_with(const VoxelRegion&);

}  // namespace shearwater::shear
