#pragma once
// Pictures as PNG files.

#include <string>

#include "common/base/result.h"
#include "common/image/image.h"

namespace shearwater::image {

// Writes to a new file beside `path` and moves it there; "-" is standard output. `note` is text that the
// picture carries along, none if empty.
base::Status write_png(const std::string& path, const Image<Rgba8>& image, const std::string& note = {});
base::Result<Image<Rgba8>> read_png(const std::string& path);

// Whether a file begins as a PNG does.
bool is_png(const std::string& path);
// The note of a picture that was written with one, wherever in the file it is; not_found without. At most
// longest_note bytes.
inline constexpr std::size_t longest_note = std::size_t{1} << 20;
base::Result<std::string> read_png_note(const std::string& path);

}  // namespace shearwater::image
