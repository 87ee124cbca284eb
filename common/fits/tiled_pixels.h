#pragma once
// Boxes of physical values of a tile-compressed image, through cfitsio.

#include <fitsio.h>

#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/fits/axes.h"
#include "common/fits/bytes.h"
#include "common/fits/encoding.h"
#include "common/fits/hdu.h"
#include "common/fits/tile_guard.h"
#include "common/volume/box.h"

namespace shearwater::fits {

class TiledPixels {
  public:
    TiledPixels() = default;

    // Moves the handle to the HDU and makes sure that cfitsio reads the same shape from the header as
    // was judged.
    static base::Result<TiledPixels> prepare(fitsfile* file, const Hdu& hdu, const CubeAxes& axes,
                                             const Encoding& encoding, const std::string& operation);

    // Fills `out` with the voxels of the planes lo to hi of `box`. BLANK integers are NaN. Doubles beyond
    // single precision become infinite, and so blank. In one thread at a time.
    base::Status read(fitsfile* file, const Bytes& bytes, const volume::Box& box, std::span<float> out,
                      const std::string& operation, const std::stop_token& stop);

    // Whether a tile is a row of the cube, or a part of one.
    bool has_row_tiles() const;

  private:
    // First and last pixel along each axis of the file, from 1 and both included.
    struct Range {
        std::vector<long> first, last;
    };
    // What stays the same all through one reading.
    struct Reading {
        fitsfile* file;
        const Bytes& bytes;
        const std::string& operation;
        const std::stop_token& stop;
    };
    Range range_of(const volume::Box& box) const;
    volume::Index3 block_of(const volume::Box& box) const;
    base::Status read_block(const Reading& reading, const volume::Box& block, std::span<float> out);

    CubeAxes axes_;
    std::size_t dimensions_ = 0;      // of the file's image
    std::vector<std::int64_t> tile_;  // its lengths
    TileGuard guard_;
    bool wide_ = false;  // stored as doubles
};

}  // namespace shearwater::fits
