#pragma once
// Where an image is not transparent, by blocks of 16 pixels of a row: most of a picture may be empty sky, and
// is told from the rest sooner than it is resampled.

#include <cstdint>
#include <span>
#include <vector>

#include "common/image/image.h"

namespace shearwater::image {

// Half-open range of pixels or cells of a row.
struct Range {
    int first = 0, end = 0;
    bool empty() const { return end <= first; }
    bool contains(int i) const { return first <= i && i < end; }
};

class LitBlocks {
  public:
    LitBlocks() = default;
    // Of an image that is transparent so far.
    LitBlocks(int width, int height);

    // Row y has these pixels from x on. Gives the least range, in the image's pixels, that holds all of them
    // that are not transparent. Where nearly all seem to be so, none is left out of it. Rows may be noted by
    // several threads.
    Range note(int x, int y, std::span<const RgbaF> pixels);

    // False only if all of the image's pixels in the rectangle are transparent.
    bool any(const Rect& rect) const;

  private:
    static constexpr int block = 16;
    static constexpr int bits = 64;

    std::span<std::uint64_t> row(int y);
    std::span<const std::uint64_t> row(int y) const;

    int width_ = 0, height_ = 0;
    std::size_t words_ = 0;  // a row
    std::vector<std::uint64_t> lit_;
};

}  // namespace shearwater::image
