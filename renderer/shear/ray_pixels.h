#pragma once
// What rays have gathered, as pixels of a window.

#include <cstddef>
#include <span>

#include "common/image/image.h"
#include "renderer/shear/kernel.h"

namespace shearwater::shear {

// Premultiplied colours of rays that follow one another in a row, `first` being the first one's place in the
// arrays. With a table in one hue they are what the rays have gathered of it times `hue`; else `hue` is null.
// A ray that is done becomes opaque: what it would have gathered yet is taken to be as what it has. Else it
// would be darker than its neighbours, and another sub-volume's light would shine through.
void pixels_of(const Rays& rays, std::ptrdiff_t first, const view::Rgb* hue, std::span<image::RgbaF> out);

// Makes pixels transparent, past the caches: most of a window may be so, is not looked at again, and would
// have to be fetched from whichever processor had it last. Others may read them after flush_cleared().
void clear_pixels(std::span<image::RgbaF> out);
void flush_cleared();

}  // namespace shearwater::shear
