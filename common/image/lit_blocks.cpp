#include "common/image/lit_blocks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "common/image/image.h"

namespace shearwater::image {

namespace {

bool has_light(std::span<const RgbaF> pixels) {
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
        while (begin + block <= end && !has_light(row.subspan(begin, block))) {
            begin += block;
        }
    }
    for (const std::size_t block : {std::size_t{16}, std::size_t{1}}) {
        while (begin + block <= end && !has_light(row.subspan(end - block, block))) {
            end -= block;
        }
    }
    return {static_cast<int>(begin), static_cast<int>(end)};
}

// Looks at a few pixels only.
bool seems_full(std::span<const RgbaF> pixels) {
    constexpr std::size_t looks = 6;
    for (std::size_t n = 0; n < looks; ++n) {
        if (!has_light(pixels.subspan(n * pixels.size() / looks, 1))) {
            return false;
        }
    }
    return true;
}

}  // namespace

LitBlocks::LitBlocks(int width, int height)
    : width_(width),
      height_(height),
      across_(static_cast<std::size_t>((width + block - 1) / block)),
      lit_(across_ * static_cast<std::size_t>(height) + at_once) {}

std::span<std::uint8_t> LitBlocks::row(int y) {
    return std::span(lit_).subspan(static_cast<std::size_t>(y) * across_, across_);
}
std::span<const std::uint8_t> LitBlocks::row(int y) const {
    return std::span(lit_).subspan(static_cast<std::size_t>(y) * across_, across_);
}

Range LitBlocks::note(int x, int y, std::span<const RgbaF> pixels) {
    const Range part = image::lit_of(pixels);
    if (part.empty()) {
        return {};
    }
    const Range range{x + part.first, x + part.end};
    const auto lit =
        pixels.subspan(static_cast<std::size_t>(part.first), static_cast<std::size_t>(part.end - part.first));
    const bool full = seems_full(lit);
    const auto blocks = row(y);
    for (int begin = range.first, end = 0; begin < range.end; begin = end) {
        end = std::min((begin / block + 1) * block, range.end);
        if (full || has_light(lit.subspan(static_cast<std::size_t>(begin - range.first),
                                          static_cast<std::size_t>(end - begin)))) {
            blocks[static_cast<std::size_t>(begin / block)] = 1;
        }
    }
    return range;
}

Range LitBlocks::lit_of(int y, const Range& pixels) const {
    if (pixels.empty()) {
        return {};
    }
    const auto blocks = row(y);
    int first = pixels.first / block, end = (pixels.end - 1) / block + 1;
    while (first < end && blocks[static_cast<std::size_t>(first)] == 0) {
        ++first;
    }
    while (first < end && blocks[static_cast<std::size_t>(end - 1)] == 0) {
        --end;
    }
    return first < end ? Range{std::max(first * block, pixels.first), std::min(end * block, pixels.end)}
                       : Range{};
}

bool LitBlocks::any(const Rect& rect) const {
    const Rect inside = view::intersection(rect, {0, 0, width_, height_});
    if (inside.empty()) {
        return false;
    }
    // Eight bytes at a time: there are as many behind the last.
    const int first = inside.x0 / block, end = (inside.x1 - 1) / block + 1;
    for (int y = inside.y0; y < inside.y1; ++y) {
        for (int n = first; n < end; n += at_once) {
            std::uint64_t blocks = 0;
            std::memcpy(&blocks, &lit_[static_cast<std::size_t>(y) * across_ + static_cast<std::size_t>(n)],
                        at_once);
            const int beyond = std::max(at_once - (end - n), 0);
            const std::uint64_t asked = std::endian::native == std::endian::little
                                            ? ~std::uint64_t{0} >> (8 * beyond)
                                            : ~std::uint64_t{0} << (8 * beyond);
            if ((blocks & asked) != 0) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace shearwater::image
