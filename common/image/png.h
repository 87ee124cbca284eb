#pragma once
// Pictures as PNG files.

#include <string>

#include "common/base/result.h"
#include "common/image/image.h"

namespace shearwater::image {

// Writes to a new file beside `path` and moves it there; "-" is standard output.
base::Status write_png(const std::string& path, const Image<Rgba8>& image);
base::Result<Image<Rgba8>> read_png(const std::string& path);

}  // namespace shearwater::image
