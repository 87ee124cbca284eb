#pragma once
// The associative over operator (DVR 2.1, equations 4 and 5) on premultiplied pixels and windows.

#include <span>
#include <vector>

#include "common/image/image.h"

namespace shearwater::image {

// front over back, pixel by pixel, into front. Spans of one length.
void over(std::span<RgbaF> front, std::span<const RgbaF> back);
// The same with the back as it came over a link.
void over(std::span<RgbaF> front, std::span<const Rgba16> back);

// To and from the form windows travel in: rounded to the nearest of 65536 levels. Spans of one length.
void to_16_bits(std::span<const RgbaF> from, std::span<Rgba16> to);
void from_16_bits(std::span<const Rgba16> from, std::span<RgbaF> to);

// A window's pixels as they travel, not owned: area(rect) pixels, row 0 first.
struct WindowView16 {
    int face;
    Rect rect;
    std::span<const Rgba16> pixels;
};

// Merges windows given front to back into at most one window per face, each with the bounding rectangle
// of its parts. Windows of different faces never mix.
std::vector<Window> merge_front_to_back(std::span<const WindowView16> windows);
std::vector<Window> merge_front_to_back(std::span<const Window> windows);

}  // namespace shearwater::image
