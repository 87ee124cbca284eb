#pragma once
// Tile-compressed images: everything that cfitsio's decoders take on trust is checked here first.

#include "common/base/result.h"
#include "common/fits/bytes.h"
#include "common/fits/hdu.h"

namespace shearwater::fits {

// Replaces the table's shape by the image's (ZBITPIX, ZNAXISn), in a compressed image HDU. Refuses
// shapes and tile sizes that contradict themselves, the number of rows, or what so few bytes can hold.
base::Status read_compressed_shape(Hdu& hdu, const std::string& operation);

// Checks that the table's array descriptors stay inside its heap, and what HCOMPRESS streams say of
// their own size. Reads the table, not the heap.
base::Status check_tiles(const Hdu& hdu, const Bytes& bytes, const std::string& operation);

}  // namespace shearwater::fits
