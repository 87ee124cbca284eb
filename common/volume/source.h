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
    // axis 0 fastest: box.voxels() of them, blank ones NaN.
    virtual base::Status read(const Box& box, std::span<float> out) = 0;

    // Whether read() may be called from several threads at once, and small boxes cost no more than large
    // ones. If not, it is called from one thread at a time, best for large boxes.
    virtual bool concurrent() const { return false; }

    // Whether a single row along axis 0 costs no more than its share of the cube.
    virtual bool gives_rows() const { return concurrent(); }
};

// Told the share done, 0 to 1, now and then while something long runs.
using Progress = std::function<void(double)>;

}  // namespace shearwater::volume
