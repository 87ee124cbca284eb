#pragma once
// A cube by what the person calls it: a FITS file's path, or the name of one that is made by formula.

#include <memory>
#include <string>

#include "common/fits/cube.h"
#include "common/volume/source.h"

namespace shearwater::cube {

struct Cube {
    std::unique_ptr<volume::VoxelSource> source;
    fits::CubeInfo info;
};

// Errors as fits::Cube::open and synthetic::Source::open have them. Of a synthetic cube's axes and HDU
// only the first of each is there, so `options` count for nothing.
base::Result<Cube> open(const std::string& path, const fits::OpenOptions& options = {});

// The path that any other process on this machine can open it by.
std::string absolute(const std::string& path);

}  // namespace shearwater::cube
