#pragma once
// The least that culling by blocks could draw: what a sequential pass finds (POF 5).

#include "common/base/workers.h"
#include "common/culling/block_grid.h"
#include "common/view/factorisation.h"
#include "renderer/shear/render.h"

namespace shearwater::bench {

// Those of `blocks`, a grid's, through which some ray goes whose true opacity before the block's slab is
// below the threshold. A slab is a layer of blocks across the face's principal axis.
culling::BlockSet optimal_blocks(const shear::BrickVolume& volume,
                                 const shear::Classification& classification,
                                 const view::Factorisation& factorisation, const culling::BlockGrid& grid,
                                 const culling::BlockSet& blocks, double threshold, base::Workers& workers);

}  // namespace shearwater::bench
