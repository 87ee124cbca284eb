#pragma once
// What the header of a tile-compressed image says, judged before cfitsio acts on it.

#include <cstdint>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/fits/hdu.h"
#include "common/fits/tile_guard.h"

namespace shearwater::fits {

// Replaces the table's shape by the image's (ZBITPIX, ZNAXISn), in a compressed image HDU. Refuses
// shapes and tile sizes that contradict themselves, the number of rows, or what so few bytes can hold.
base::Status read_compressed_shape(Hdu& hdu, const std::string& operation);

// The lengths of a tile along each axis, once the shape has been read.
std::vector<std::int64_t> tile_lengths(const Hdu& hdu);

// The table that holds the tiles, a row each, and its heap.
struct Table {
    std::int64_t rows, row_bytes, heap_offset, heap_bytes;
};
Table table_of(const Hdu& hdu);

RiceParameters rice_parameters(const Header& header);

// A guard over the tiles' bytes; an error where the table's columns make no sense.
base::Result<TileGuard> guard_tiles(const Hdu& hdu, const std::string& operation);

}  // namespace shearwater::fits
