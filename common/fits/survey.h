#pragma once
// The walk over a file's HDUs that finds the cube.

#include <optional>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/fits/bytes.h"
#include "common/fits/hdu.h"

namespace shearwater::fits {

struct Survey {
    Hdu cube;
    std::vector<std::string> notes;
};

// The first HDU that holds an image of three or four axes longer than 1, or the image HDU asked for,
// with all its data present in the file.
base::Result<Survey> find_cube(const Bytes& bytes, const std::optional<int>& wanted,
                               const std::string& operation);

}  // namespace shearwater::fits
