#pragma once
// Cubes of cells on a grid global to the cube, whatever the box that is looked at: all of the same edge, but
// for the last along an axis, which the cube's end may cut off.

#include <cstddef>
#include <cstdint>

#include "common/volume/box.h"

namespace shearwater::volume {

struct CellGrid {
    Index3 n;           // voxels of the cube
    std::int64_t edge;  // voxels

    // Along an axis, with the last whether cut off or not,
    std::int64_t count(std::size_t axis) const { return (n[axis] - 2 + edge) / edge; }
    // and without it where it is.
    std::int64_t count_uncut(std::size_t axis) const { return (n[axis] - 1) / edge; }

    // Those that lie in a box of voxels with all that the cube has of them: [lo, hi) along every axis, lo <=
    // hi. One that a cut between two boxes passes through is in neither's; one cut off by the cube's end may
    // be in one's.
    Box within(const Box& box) const;
};

}  // namespace shearwater::volume
