#pragma once
// What functions are made from: cells in a row, planes of rows, each with the least extinction of all that
// rays may meet in it. They lie between the nodes of a level, or, for a first and coarser answer, are its
// octants, whose codes are known without a look at the nodes.
//
// On a coarse level they are its own, between nodes 2^level voxels apart. Those that no one sub-volume has
// wholly, across its faces or the cube's end, are known to none: whoever asks counts them as clear, and asks
// nothing of lines that pass beyond the last whole ones of the cube (common/culling/visible_blocks.cpp).

#include <cstdint>
#include <functional>
#include <span>

#include "common/volume/box.h"
#include "renderer/culling/least_extinctions.h"
#include "renderer/shear/brick_volume.h"

namespace shearwater::culling {

struct Cells {
    volume::Box box;      // that are wholly the sub-volume's
    volume::Box known;    // and those around that something is known of
    volume::Index3 n;     // voxels of the whole cube
    std::int64_t voxels;  // along a cell's side
    // Extinctions in units of the known cells of a row along axis 0 from one on.
    std::function<void(const volume::Index3& first, std::span<std::int16_t> units)> row;
};

// Of a level of a volume; on level 0 with its halo.
Cells cells_of_nodes(const shear::BrickVolume& volume, int level, const LeastExtinctions& extinctions);
// Of its voxels, with its halo.
Cells cells_of_octants(const shear::BrickVolume& volume, const LeastExtinctions& extinctions);

}  // namespace shearwater::culling
