#pragma once
// Where a tile finds the voxels of a few planes across the principal axis: in the volume itself, or, where
// its voxels are adjacent along that axis, in a copy that is turned so that they are along the fast one.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/shear/code_volume.h"
#include "renderer/shear/face_plan.h"
#include "renderer/shear/kernel.h"
#include "renderer/shear/voxel_region.h"

namespace shearwater::shear {

// What has to be fetched for a region of codes, `axes` being the fast, the slow and the principal one.
template <class Code>
Ahead ahead_of(const CodeArray& codes, const std::array<int, 3>& axes, const VoxelRegion& region);

template <class Code>
class TileVoxels {
  public:
    // Both have to outlive it.
    TileVoxels(const CodeVolume& volume, const FacePlan& plan);

    // Whether they are turned, and fetched for that.
    bool turns() const { return turns(codes_, axes_[2]); }
    static bool turns(const CodeArray& codes, int principal_axis) {
        return codes.adjacent_axis() == principal_axis;
    }
    // Whether a region can be found: where voxels have to be turned, it has to be before.
    bool has(const VoxelRegion& region) const;
    // `more` is what may be asked for next.
    void turn(const VoxelRegion& region, std::span<const VoxelRegion> more);
    VoxelPlace<Code> find(const VoxelRegion& region) const;
    // What of the volume a region will take to find.
    Ahead ahead(const VoxelRegion& region) const { return ahead_of<Code>(codes_, axes_, region); }

  private:
    struct alignas(cache_line) Line {
        std::array<std::byte, cache_line> bytes;
    };

    VoxelRegion wanted_of_plane(std::int64_t v) const;

    const Code* code_at(const volume::Index3& node) const {
        return &codes_.codes<Code>()[codes_.offset(node)];
    }

    Code* copy() { return reinterpret_cast<Code*>(copy_.data()); }
    const Code* copy() const { return reinterpret_cast<const Code*>(copy_.data()); }
    // Of a node in it, along the fast, the slow and the principal axis.
    std::ptrdiff_t place_of(std::int64_t f, std::int64_t v, std::int64_t w) const {
        return (f - whole_.lo[0]) + (v - whole_.lo[1]) * row_ + (w - whole_.lo[2]) * plane_;
    }

    const CodeArray& codes_;
    std::array<int, 3> axes_;
    std::vector<Line> copy_;
    std::vector<VoxelRegion> copied_;
    VoxelRegion whole_{};                 // about them, as the copy is laid out
    std::ptrdiff_t row_ = 0, plane_ = 0;  // of the copy
};

}  // namespace shearwater::shear
