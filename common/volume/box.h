#pragma once
// Where things are in a cube. Voxel space: a point's coordinates are fractional voxel indices, voxel
// (0, 0, 0) lies at the origin, and axes 0, 1, 2 are FITS axes 1, 2, 3 (x, y, z).

#include <array>
#include <cstdint>
#include <string>

namespace shearwater::volume {

using Index3 = std::array<std::int64_t, 3>;

// A region of voxel space, half-open: it owns the points with lo <= p < hi on every axis. Whoever
// renders it stores the voxel planes lo to hi, both included, so that neighbours share one plane and a
// point between two planes has both (DVR 3.2). The region of a whole cube is [0, n-1); points on its
// upper faces belong to whichever box ends there.
struct Box {
    Index3 lo{};
    Index3 hi{};

    bool operator==(const Box&) const = default;

    std::int64_t cells(int axis) const { return hi[axis] - lo[axis]; }
    std::int64_t planes(int axis) const { return cells(axis) + 1; }
    Index3 plane_counts() const { return {planes(0), planes(1), planes(2)}; }
    std::int64_t voxels() const { return planes(0) * planes(1) * planes(2); }
    bool contains(const Box& inner) const;
};

// The region between the first and last voxel centre of a cube of n voxels.
Box whole(const Index3& n);

// The planes that a box of a cube of n voxels owns, first and last both included: all but its upper ones, where it
// does not end with the cube. No voxel is in two boxes' of a division, and each is in one's.
Box owned_planes(const Box& box, const Index3& n);

// "[0,64) x [0,64) x [32,64)"
std::string to_string(const Box& box);

// n0 * n1 * n2, or -1 where that does not fit in 63 bits or an n is negative.
std::int64_t voxel_count(const Index3& n);

}  // namespace shearwater::volume
