#pragma once
// What functions are made from: cells in a row, planes of rows, each with the least extinction of all that
// rays may meet in it. They lie between the nodes of a level, or, for a first and coarser answer, are its
// octants, whose codes are known without a look at the nodes.
//
// On a coarse level they are its own, between nodes 2^level voxels apart. Those across a sub-volume's faces
// are known to none: whoever asks counts them as clear. One across the cube's end is cut off there, and is of
// the sub-volume that has what is left of it.

#include <cstdint>
#include <functional>
#include <span>

#include "common/volume/cell_grid.h"
#include "renderer/culling/least_extinctions.h"
#include "renderer/shear/brick_volume.h"

namespace shearwater::culling {

struct Cells {
    volume::CellGrid grid;
    volume::Box box;    // those that are the sub-volume's
    volume::Box known;  // and those around that something is known of
    // Extinctions in units of the known cells of a row along axis 0 from one on.
    std::function<void(const volume::Index3& first, std::span<std::int16_t> units)> row;
};

// Of a level of a volume; on level 0 with its halo.
Cells cells_of_nodes(const shear::BrickVolume& volume, int level, const LeastExtinctions& extinctions);
// Of its voxels, with its halo.
Cells cells_of_octants(const shear::BrickVolume& volume, const LeastExtinctions& extinctions);

}  // namespace shearwater::culling
