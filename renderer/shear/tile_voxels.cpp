#include "renderer/shear/tile_voxels.h"

#include <algorithm>
#include <optional>
#include <utility>

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

void VoxelRegion::add(const VoxelRegion& other) {
    for (std::size_t n = 0; n < 3; ++n) {
        lo[n] = std::min(lo[n], other.lo[n]);
        hi[n] = std::max(hi[n], other.hi[n]);
    }
}

template <class Code>
TileVoxels<Code>::TileVoxels(const CodeVolume& volume, const FacePlan& plan)
    : codes_(volume.best_for(plan.face().axis)),
      axes_{plan.fast_axis(), plan.slow_axis(), plan.face().axis} {}

template <class Code>
bool TileVoxels<Code>::has(const VoxelRegion& region) const {
    return !turns() ||
           std::ranges::any_of(copied_, [&](const VoxelRegion& part) { return part.contains(region); });
}

template <class Code>
VoxelPlace<Code> TileVoxels<Code>::find(const VoxelRegion& region) const {
    if (!turns()) {
        volume::Index3 at;
        for (std::size_t n = 0; n < 3; ++n) {
            at[static_cast<std::size_t>(axes_[n])] = region.lo[n];
        }
        return {code_at(at), codes_.stride(axes_[1]), codes_.stride(axes_[2])};
    }
    return {copy() + place_of(region.lo[0], region.lo[1], region.lo[2]), row_, plane_};
}

template <class Code>
Ahead ahead_of(const CodeArray& codes, const std::array<int, 3>& axes, const VoxelRegion& region) {
    volume::Index3 at;
    for (std::size_t n = 0; n < 3; ++n) {
        at[static_cast<std::size_t>(axes[n])] = region.lo[n];
    }
    const auto count = [&](std::size_t n) { return static_cast<int>(region.count(n)); };
    const auto bytes = [](std::ptrdiff_t codes_on) {
        return codes_on * static_cast<std::ptrdiff_t>(sizeof(Code));
    };
    const auto* const first = reinterpret_cast<const char*>(&codes.codes<Code>()[codes.offset(at)]);
    const auto lines = [&](int side_by_side) {
        const auto offset = static_cast<int>(reinterpret_cast<std::uintptr_t>(first) % cache_line);
        return (offset + side_by_side * static_cast<int>(sizeof(Code)) + cache_line - 1) / cache_line;
    };
    // Codes are adjacent along the fast axis, or, where they are to be turned, the principal one.
    const bool turned = codes.adjacent_axis() == axes[2];
    const std::size_t row = turned ? 0 : 1;
    const std::size_t plane = turned ? 1 : 2;
    return {.first = first,
            .row_stride = bytes(codes.stride(axes[row])),
            .plane_stride = bytes(codes.stride(axes[plane])),
            .lines = lines(turned ? count(2) : count(0)),
            .rows = count(row),
            .planes = count(plane)};
}

template <class Code>
void TileVoxels<Code>::turn(const VoxelRegion& region, std::span<const VoxelRegion> more) {
    copied_.assign(more.begin(), more.end());
    if (std::ranges::none_of(more, [&](const VoxelRegion& part) { return part.contains(region); })) {
        copied_.push_back(region);
    }
    whole_ = copied_.front();
    for (const VoxelRegion& part : copied_) {
        whole_.add(part);
    }
    // Rows begin where lines of the cache do. What planes have at one place is written together: an odd
    // number of lines keeps it apart in the caches. Whole blocks are written: there has to be room for the
    // last of them, along both axes.
    constexpr std::int64_t block = 16;
    constexpr std::int64_t line = cache_line / static_cast<std::int64_t>(sizeof(Code));
    const auto whole = [](std::int64_t codes, std::int64_t of) { return (codes + of - 1) / of * of; };
    row_ = whole(whole_.count(0) + block, line);
    plane_ = (row_ / line * whole_.count(1) | 1) * line;
    const auto needed =
        static_cast<std::size_t>(plane_ / line * (whole_.count(2) + block)) + voxel_padding / cache_line;
    if (copy_.size() < needed) {
        copy_.resize(needed);
    }
    for (std::int64_t v = whole_.lo[1]; v <= whole_.hi[1]; ++v) {
        // From block to block, as far as there are codes.
        VoxelRegion wanted = wanted_of_plane(v);
        wanted.lo[0] -= (wanted.lo[0] - whole_.lo[0]) % block;
        const auto [f0, w0] = std::pair(wanted.lo[0], wanted.lo[2]);
        const std::int64_t rows = std::min(whole(wanted.count(0), block), codes_.box().hi[1] - f0 + 1);
        shear::turn(Matrix<Code>{.first = code_at({w0, f0, v}),
                                 .row_stride = codes_.stride(1),
                                 .columns = static_cast<int>(wanted.count(2)),
                                 .rows = static_cast<int>(rows)},
                    copy() + place_of(f0, v, w0), plane_,
                    v < whole_.hi[1] ? ahead(wanted_of_plane(v + 1)) : Ahead{});
    }
}

// Of a plane across the slow axis what some part has of it: the parts' planes follow one another. Here the
// fast axis is 1, the slow one 2.
template <class Code>
VoxelRegion TileVoxels<Code>::wanted_of_plane(std::int64_t v) const {
    if (copied_.size() == 1) {
        VoxelRegion plane = whole_;
        plane.lo[1] = plane.hi[1] = v;
        return plane;
    }
    std::optional<VoxelRegion> wanted;
    for (const VoxelRegion& part : copied_) {
        if (part.lo[1] <= v && v <= part.hi[1]) {
            wanted = wanted.value_or(part);
            wanted->add(part);
        }
    }
    // Parts that follow one another meet: no plane is between them.
    VoxelRegion plane = wanted.value_or(whole_);
    // Of lines of the cache most are as soon turned whole.
    if (2 * (plane.hi[2] - plane.lo[2]) > whole_.hi[2] - whole_.lo[2]) {
        plane.lo[2] = whole_.lo[2];
        plane.hi[2] = whole_.hi[2];
    }
    plane.lo[1] = plane.hi[1] = v;
    return plane;
}

template Ahead ahead_of<std::uint8_t>(const CodeArray&, const std::array<int, 3>&, const VoxelRegion&);
template Ahead ahead_of<std::uint16_t>(const CodeArray&, const std::array<int, 3>&, const VoxelRegion&);
template class TileVoxels<std::uint8_t>;
template class TileVoxels<std::uint16_t>;

}  // namespace shearwater::shear
