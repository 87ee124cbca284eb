#pragma once
// The whole pipeline in this process: --tree 1,1.

#include "common/options/cube_options.h"
#include "common/volume/source.h"
#include "deploy/picture.h"
#include "deploy/script.h"

namespace shearwater::deploy {

// Draws the script's pictures. Progress covers both passes over the voxels, and the pictures where they are
// several.
base::Result<Picture> draw_in_process(const options::CubeOptions& cube, const ViewOptions& view,
                                      const Script& script, int threads, const volume::Progress& progress);

}  // namespace shearwater::deploy
