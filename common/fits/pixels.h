#pragma once
// Boxes of physical values, through cfitsio.

#include <fitsio.h>

#include <span>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/fits/axes.h"
#include "common/fits/bytes.h"
#include "common/fits/hdu.h"
#include "common/fits/tile_guard.h"
#include "common/volume/box.h"

namespace shearwater::fits {

class PixelReader {
  public:
    PixelReader() = default;

    // Moves the handle to the HDU and makes sure that cfitsio reads the same shape from the header as
    // was judged. Scaling that cannot be used is repaired, with a note.
    static base::Result<PixelReader> prepare(fitsfile* file, const Hdu& hdu, const CubeAxes& axes,
                                             const std::string& operation, std::vector<std::string>& notes);

    // Fills `out` with the voxels of the planes lo to hi of `box`. BLANK integers are NaN; floating-point
    // values are as stored. Doubles beyond single precision become infinite, and so blank.
    base::Status read(fitsfile* file, const Bytes& bytes, const volume::Box& box, std::span<float> out,
                      const std::string& operation);

  private:
    // First and last pixel along each axis of the file, from 1 and both included.
    struct Range {
        std::vector<long> first, last;
    };
    Range range_of(const volume::Box& box) const;
    bool contiguous(const Range& range) const;
    base::Status read_range(fitsfile* file, Range range, std::span<float> out,
                            const std::string& operation) const;
    template <class Value>
    int read_values(fitsfile* file, Range& range, std::span<Value> out) const;

    CubeAxes axes_;
    std::vector<std::int64_t> lengths_;  // of all axes of the file
    TileGuard guard_;                    // of a compressed image
    bool compressed_ = false;
    bool integer_ = false;
    bool wide_ = false;  // stored as doubles
};

}  // namespace shearwater::fits
