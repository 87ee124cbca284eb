#pragma once
// Where voxels come from: a file, a link, or a formula in a test.

#include <functional>
#include <span>

#include "common/base/result.h"
#include "common/volume/box.h"

namespace shearwater::volume {

class VoxelSource {
  public:
    virtual ~VoxelSource() = default;

    // Fills `out` with the physical values of the voxels of planes lo to hi (both included) of `box`,
    // axis 0 fastest: box.voxels() of them, blank ones NaN. Called from one thread at a time.
    virtual base::Status read(const Box& box, std::span<float> out) = 0;
};

// Told the share done, 0 to 1, now and then while something long runs.
using Progress = std::function<void(double)>;

}  // namespace shearwater::volume
