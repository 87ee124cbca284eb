#pragma once
// Where an image is not transparent, by blocks of 16 pixels of a row: most of a picture may be empty sky, and
// is told from the rest sooner than it is resampled.

#include <cstdint>
#include <span>
#include <vector>

#include "common/view/factorisation.h"

namespace shearwater::image {

struct RgbaF;
using view::Rect;

// Half-open range of pixels or cells of a row.
struct Range {
    int first = 0, end = 0;
    bool empty() const { return end <= first; }
    bool contains(int i) const { return first <= i && i < end; }
};

class LitBlocks {
  public:
    LitBlocks() = default;
    static constexpr int block = 16;

    // Of an image that is transparent so far.
    LitBlocks(int width, int height);
    // Of no image.
    bool empty() const { return lit_.empty(); }

    // Row y has these pixels from x on. Gives the least range, in the image's pixels, that holds all of them
    // that are not transparent. Where nearly all seem to be so, none is left out of it. Several threads may
    // note what has no block in common.
    Range note(int x, int y, std::span<const RgbaF> pixels);

    // That a pixel of row y is lit.
    void light(int x, int y) { row(y)[static_cast<std::size_t>(x / block)] = 1; }

    // False only if the block of 16 that pixel x of row y is in is transparent.
    bool is_lit(int x, int y) const { return row(y)[static_cast<std::size_t>(x / block)] != 0; }

    // Holds all of row y's pixels of a range that are not transparent, by whole blocks.
    Range lit_of(int y, const Range& pixels) const;
    // False only if all of the image's pixels in the rectangle are transparent.
    bool any(const Rect& rect) const;

  private:
    static constexpr int at_once = 8;  // blocks that are looked at

    std::span<std::uint8_t> row(int y);
    std::span<const std::uint8_t> row(int y) const;

    int width_ = 0, height_ = 0;
    std::size_t across_ = 0;         // blocks a row
    std::vector<std::uint8_t> lit_;  // a byte each
};

}  // namespace shearwater::image
