#pragma once
// The whole pipeline in this process: --tree 1,1.

#include "common/options/cube_options.h"
#include "common/view/anchored_function.h"
#include "common/volume/source.h"
#include "deploy/picture.h"
#include "deploy/view_options.h"

namespace shearwater::deploy {

// Draws the picture `repeat` times. Progress covers both passes over the voxels.
base::Result<Picture> draw_in_process(const options::CubeOptions& cube, const ViewOptions& view,
                                      const view::AnchoredFunction& function, int threads, int repeat,
                                      const volume::Progress& progress);

}  // namespace shearwater::deploy
