#pragma once
// The end of a picture: pixels put over a background and rounded to 8 bits.

#include <span>

#include "common/image/image.h"
#include "common/view/transfer_function.h"

namespace shearwater::image {

// Premultiplied pixels within the gamut, to the nearest of 256 levels; alpha is 255. Spans of one length.
void finish(std::span<const RgbaF> from, const view::Rgb& background, std::span<Rgba8> to);

}  // namespace shearwater::image
