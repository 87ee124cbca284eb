#include "renderer/shear/tile_voxels.h"

#include <algorithm>

#include "renderer/shear/kernel.h"
#include "renderer/shear/transpose.h"

namespace shearwater::shear {

bool VoxelRegion::contains(const VoxelRegion& inner) const {
    for (std::size_t n = 0; n < 3; ++n) {
        if (inner.lo[n] < lo[n] || inner.hi[n] > hi[n]) {
            return false;
        }
    }
    return true;
}

template <class Code>
TileVoxels<Code>::TileVoxels(const CodeVolume& volume, const FacePlan& plan)
    : volume_(volume),
      codes_(volume.codes<Code>()),
      axes_{plan.fast_axis(), plan.slow_axis(), plan.face().axis},
      copied_{{0, 0, 0}, {-1, -1, -1}} {}

template <class Code>
typename TileVoxels<Code>::Place TileVoxels<Code>::find(const VoxelRegion& region, const VoxelRegion& more) {
    if (axes_[2] != 0) {
        volume::Index3 at;
        for (std::size_t n = 0; n < 3; ++n) {
            at[static_cast<std::size_t>(axes_[n])] = region.lo[n];
        }
        return {&codes_[volume_.offset(at)], volume_.stride(axes_[1]), volume_.stride(axes_[2])};
    }
    if (!copied_.contains(region)) {
        turn(more);
    }
    const std::ptrdiff_t offset = (region.lo[0] - copied_.lo[0]) + (region.lo[1] - copied_.lo[1]) * row_ +
                                  (region.lo[2] - copied_.lo[2]) * plane_;
    return {&copy_[static_cast<std::size_t>(offset)], row_, plane_};
}

template <class Code>
Ahead TileVoxels<Code>::ahead(const VoxelRegion& region) const {
    volume::Index3 at;
    for (std::size_t n = 0; n < 3; ++n) {
        at[static_cast<std::size_t>(axes_[n])] = region.lo[n];
    }
    const auto count = [&](std::size_t n) { return static_cast<int>(region.hi[n] - region.lo[n] + 1); };
    const auto bytes = [](std::ptrdiff_t codes) { return codes * static_cast<std::ptrdiff_t>(sizeof(Code)); };
    const auto* const first = reinterpret_cast<const char*>(&codes_[volume_.offset(at)]);
    const auto lines = [&](int codes) {
        const auto offset = static_cast<int>(reinterpret_cast<std::uintptr_t>(first) % cache_line);
        return (offset + codes * static_cast<int>(sizeof(Code)) + cache_line - 1) / cache_line;
    };
    // Voxels are adjacent along axis 0: the fast one, or, where they are to be turned, the principal one.
    const std::size_t row = axes_[2] == 0 ? 0 : 1;
    const std::size_t plane = axes_[2] == 0 ? 1 : 2;
    return {.first = first,
            .row_stride = bytes(volume_.stride(axes_[row])),
            .plane_stride = bytes(volume_.stride(axes_[plane])),
            .lines = lines(axes_[2] == 0 ? count(2) : count(0)),
            .rows = count(row),
            .planes = count(plane)};
}

// Here the fast axis is 1, the slow one 2.
template <class Code>
void TileVoxels<Code>::turn(const VoxelRegion& region) {
    const auto count = [&](std::size_t n) { return region.hi[n] - region.lo[n] + 1; };
    // Whole blocks are written: there has to be room for the last of them, along both axes.
    constexpr std::int64_t block = 16;
    row_ = (count(0) + 2 * block - 1) / block * block;
    plane_ = row_ * (count(1) + 1);
    copy_.resize(static_cast<std::size_t>(plane_ * (count(2) + block)) + voxel_padding);
    copied_ = region;
    shear::turn(Stack<Code>{.first = &codes_[volume_.offset({region.lo[2], region.lo[0], region.lo[1]})],
                            .row_stride = volume_.stride(1),
                            .plane_stride = volume_.stride(2),
                            .columns = static_cast<int>(count(2)),
                            .rows = static_cast<int>(count(0)),
                            .planes = static_cast<int>(count(1))},
                copy_.data(), plane_, row_);
}

template class TileVoxels<std::uint8_t>;
template class TileVoxels<std::uint16_t>;

}  // namespace shearwater::shear
