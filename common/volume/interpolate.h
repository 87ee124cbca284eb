#pragma once
// The value between voxels, of the cube itself.

#include <array>

#include "common/volume/source.h"

namespace shearwater::volume {

// The trilinear value at a point of a cube of n voxels, inside it, in voxels: the mean of its valid corners
// where they weigh at least one half, as the kernel has it, else not a number. Reads eight voxels at most.
base::Result<double> value_at(VoxelSource& source, const Index3& n, const std::array<double, 3>& at);

}  // namespace shearwater::volume
