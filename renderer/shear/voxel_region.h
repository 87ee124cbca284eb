#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace shearwater::shear {

// Nodes of the level that is drawn, from lo to hi, both included, along a face's fast, slow and principal
// axes.
struct VoxelRegion {
    std::array<std::int64_t, 3> lo, hi;

    std::int64_t count(std::size_t axis) const { return hi[axis] - lo[axis] + 1; }
    bool contains(const VoxelRegion& inner) const;
    void add(const VoxelRegion& other);  // so that it contains that too
};

// Where the voxels of a region lie: that of plane w of the principal axis, first along the others, at
// first + (w - region.lo[2]) * plane_stride, those along the fast axis adjacent.
template <class Code>
struct VoxelPlace {
    const Code* first;
    std::ptrdiff_t row_stride, plane_stride;
};

}  // namespace shearwater::shear
