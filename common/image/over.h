#pragma once
// The associative over operator (DVR 2.1, equations 4 and 5) on premultiplied pixels. over_windows.h
// lays whole windows over one another.

#include <span>

#include "common/image/image.h"

namespace shearwater::image {

// front over back, pixel by pixel, into front. Spans of one length.
void over(std::span<RgbaF> front, std::span<const RgbaF> back);
// The same with the back as it came over a link.
void over(std::span<RgbaF> front, std::span<const Rgba16> back);

// To and from the form windows travel in: rounded to the nearest of 65536 levels. Spans of one length.
void to_16_bits(std::span<const RgbaF> from, std::span<Rgba16> to);
void from_16_bits(std::span<const Rgba16> from, std::span<RgbaF> to);

}  // namespace shearwater::image
