#pragma once
// A formula's planes into a FITS file, through cfitsio.

#include <stop_token>
#include <string>

#include "common/base/result.h"
#include "common/volume/source.h"
#include "deploy/samples/formula.h"

namespace shearwater::samples {

// As write_sample says of the file, its name and what is left of it. `bitpix` is -32 or 8.
base::Status write_cube(const Formula& formula, const volume::Index3& n, int bitpix, const std::string& path,
                        const volume::Progress& progress, const std::stop_token& stop);

}  // namespace shearwater::samples
