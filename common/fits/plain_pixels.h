#pragma once
// Boxes of physical values of an image that is not compressed, straight from the file's bytes.

#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/fits/axes.h"
#include "common/fits/bytes.h"
#include "common/fits/encoding.h"
#include "common/fits/hdu.h"
#include "common/volume/box.h"

namespace shearwater::fits {

class PlainPixels {
  public:
    // Of an image whose data are present.
    PlainPixels(const Hdu& hdu, const CubeAxes& axes, const Encoding& encoding);

    // Fills `out` with the voxels of the planes lo to hi of `box`. Any number of threads may read at once.
    base::Status read(const Bytes& bytes, const volume::Box& box, std::span<float> out,
                      const std::string& operation, const std::stop_token& stop) const;

  private:
    Encoding encoding_;
    std::int64_t first_ = 0;       // where voxel (0, 0, 0) lies in the file
    volume::Index3 byte_steps_{};  // from one voxel to the next along each axis
};

}  // namespace shearwater::fits
