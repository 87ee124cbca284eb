#pragma once
// Cubes made by formula, plane by plane, so that one larger than memory can be made.

#include <cstdint>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "common/volume/box.h"
#include "common/volume/source.h"

namespace shearwater::samples {

struct SampleKind {
    std::string_view name;
    std::string_view description;
    bool bytes = false;  // may be written in 8 bits
};

// "hi-galaxy", "nbody-web", and all of synthetic::kinds().
std::vector<SampleKind> kinds();

// Writes the named sample of n voxels, each axis longer than 1, as a FITS file of 32-bit floats
// (`bitpix` -32) or, rounded, of 8-bit whole numbers (8). The same
// name, size and seed give the same file. It is written beside `path` under a name of its own and
// renamed when whole; after a fault or a stop nothing is left. Holds a few planes and the sample's
// parts in memory.
base::Status write_sample(std::string_view name, const volume::Index3& n, std::uint64_t seed,
                          const std::string& path, const volume::Progress& progress = {},
                          const std::stop_token& stop = {}, int bitpix = -32);

}  // namespace shearwater::samples
