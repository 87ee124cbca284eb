#include "common/image/lit_blocks.h"

#include <algorithm>
#include <array>
#include <bit>

namespace shearwater::image {

namespace {

bool is_lit(std::span<const RgbaF> pixels) {
    std::uint64_t bits = 0;
    for (const RgbaF& pixel : pixels) {
        const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(pixel);
        bits |= halves[0] | halves[1];
    }
    return bits != 0;
}

// From the first pixel that is not transparent to the last. Most of those that are go a block at a time.
Range lit_of(std::span<const RgbaF> row) {
    std::size_t begin = 0, end = row.size();
    for (const std::size_t block : {std::size_t{16}, std::size_t{1}}) {
        while (begin + block <= end && !is_lit(row.subspan(begin, block))) {
            begin += block;
        }
    }
    for (const std::size_t block : {std::size_t{16}, std::size_t{1}}) {
        while (begin + block <= end && !is_lit(row.subspan(end - block, block))) {
            end -= block;
        }
    }
    return {static_cast<int>(begin), static_cast<int>(end)};
}

// Looks at a few pixels only.
bool seems_full(std::span<const RgbaF> pixels) {
    constexpr std::size_t looks = 6;
    for (std::size_t n = 0; n < looks; ++n) {
        if (!is_lit(pixels.subspan(n * pixels.size() / looks, 1))) {
            return false;
        }
    }
    return true;
}

std::uint64_t bit(int n) {
    return std::uint64_t{1} << n;
}

}  // namespace

LitBlocks::LitBlocks(int width, int height)
    : width_(width),
      height_(height),
      words_(static_cast<std::size_t>((width + block * bits - 1) / (block * bits))),
      lit_(words_ * static_cast<std::size_t>(height)) {}

std::span<std::uint64_t> LitBlocks::row(int y) {
    return std::span(lit_).subspan(static_cast<std::size_t>(y) * words_, words_);
}
std::span<const std::uint64_t> LitBlocks::row(int y) const {
    return std::span(lit_).subspan(static_cast<std::size_t>(y) * words_, words_);
}

Range LitBlocks::note(int x, int y, std::span<const RgbaF> pixels) {
    const Range part = lit_of(pixels);
    if (part.empty()) {
        return {};
    }
    const Range range{x + part.first, x + part.end};
    const auto lit =
        pixels.subspan(static_cast<std::size_t>(part.first), static_cast<std::size_t>(part.end - part.first));
    const bool full = seems_full(lit);
    const auto words = row(y);
    for (int begin = range.first, end = 0; begin < range.end; begin = end) {
        end = std::min((begin / block + 1) * block, range.end);
        if (full || is_lit(lit.subspan(static_cast<std::size_t>(begin - range.first),
                                       static_cast<std::size_t>(end - begin)))) {
            words[static_cast<std::size_t>(begin / block / bits)] |= bit(begin / block % bits);
        }
    }
    return range;
}

bool LitBlocks::any(const Rect& rect) const {
    const Rect inside = view::intersection(rect, {0, 0, width_, height_});
    if (inside.empty()) {
        return false;
    }
    const int first = inside.x0 / block, last = (inside.x1 - 1) / block;
    for (int word = first / bits; word <= last / bits; ++word) {
        constexpr std::uint64_t all = ~std::uint64_t{0};
        const std::uint64_t asked = (word == first / bits ? all << first % bits : all) &
                                    (word == last / bits ? all >> (bits - 1 - last % bits) : all);
        for (int y = inside.y0; y < inside.y1; ++y) {
            if ((row(y)[static_cast<std::size_t>(word)] & asked) != 0) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace shearwater::image
