#pragma once
// What functions are made from: cells in a row, planes of rows, each with the least extinction of all that
// rays may meet in it. They lie between the nodes of a level, or, for a first and coarser answer, are its
// octants, whose codes are known without a look at the nodes.

#include <cstdint>
#include <functional>
#include <span>

#include "common/volume/box.h"
#include "renderer/culling/least_extinctions.h"
#include "renderer/shear/code_volume.h"

namespace shearwater::culling {

struct Cells {
    volume::Box box;      // that are wholly the sub-volume's
    volume::Index3 n;     // voxels of the whole cube
    std::int64_t voxels;  // along a cell's side
    // Samples lie in the first part of a cell along the axis that its slices are across, so long.
    double sampled;
    // So many at the cube's ends count half: a ray's first sample there may stand for half a step, and its
    // last.
    std::int64_t ends;
    // Extinctions in units of the cells of a row along axis 0 from one on.
    std::function<void(const volume::Index3& first, std::span<std::int16_t> units)> row;
};

// Of a level of a sub-volume of a cube of n voxels.
Cells cells_of_nodes(const shear::CodeVolume& nodes, int level, const volume::Box& box,
                     const volume::Index3& n, const LeastExtinctions& extinctions);
// Of its voxels.
Cells cells_of_octants(const shear::CodeVolume& voxels, const volume::Box& box, const volume::Index3& n,
                       const LeastExtinctions& extinctions);

}  // namespace shearwater::culling
