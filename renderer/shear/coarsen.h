#pragma once
// How the nodes of a coarser level (volume/levels.h) are made: each is the mean of those of the finer one
// that are at most one away along every axis, weighed 1 2 1; blank ones count for nothing, and where they are
// more than half of the weight so is the mean. Beyond the cube's ends the last plane goes on.

#include <stop_token>

#include "common/base/workers.h"
#include "common/volume/box.h"
#include "renderer/shear/code_volume.h"

namespace shearwater::shear {

// Makes the nodes of a box that a volume of level `level` of a cube of n voxels holds from those of the next
// finer one, which holds what they are made_from; false if stopped before.
bool coarsen(const CodeVolume& fine, CodeVolume& coarse, const volume::Box& nodes, int level,
             const volume::Index3& n, base::Workers& workers, const std::stop_token& stop);

}  // namespace shearwater::shear
