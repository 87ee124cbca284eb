#pragma once
// The compressed bytes of tiles, checked before cfitsio decodes them: its decoders take a stream's own
// word for its size, and one of them never ends on a damaged stream.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/fits/bytes.h"
#include "common/fits/hdu.h"

namespace shearwater::fits {

// A column of variable-length arrays in the table of tiles.
struct ArrayColumn {
    enum class Stream { other, gzip, rice, hcompress, plio };

    std::int64_t offset = 0;  // in the row, of the array's descriptor
    bool wide = false;        // whether that has 64-bit numbers
    std::int64_t element_bytes = 1;
    Stream stream = Stream::other;
};

// How Rice's decoder counts: the bytes of a pixel, and the pixels of a block.
struct RiceParameters {
    int pixel_bytes = 4;
    int block = 32;
};

class TileGuard {
  public:
    TileGuard() = default;
    TileGuard(const Hdu& hdu, std::vector<ArrayColumn> columns);

    // Checks, once each, the tiles that hold the pixels first to last (from 1, both included) along
    // every axis of the image.
    base::Status check(const Bytes& bytes, std::span<const long> first, std::span<const long> last,
                       const std::string& operation);

  private:
    std::optional<std::string> fault(const Bytes& bytes, std::int64_t tile) const;
    bool stream_holds(ArrayColumn::Stream kind, std::span<char> stream, std::int64_t pixels) const;
    std::int64_t pixels_of(std::int64_t tile) const;

    std::vector<std::int64_t> axes_, steps_;  // lengths of the image and of a tile
    std::vector<ArrayColumn> columns_;
    RiceParameters rice_;
    std::int64_t rows_offset_ = 0;
    std::int64_t row_bytes_ = 0;
    std::int64_t heap_offset_ = 0;
    std::int64_t heap_bytes_ = 0;
    std::vector<bool> checked_;
};

}  // namespace shearwater::fits
