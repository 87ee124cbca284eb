#pragma once
// The first of the two streaming passes over a sub-volume: its histogram.

#include <stop_token>

#include "common/base/workers.h"
#include "common/volume/histogram.h"
#include "common/volume/source.h"

namespace shearwater::volume {

// Counts the voxels that `box` owns in a cube of whole(n): [lo, hi) on each axis, and the last plane
// where the box ends at the cube's edge. So the histograms of a division's boxes add up to the cube's.
// Reads slab by slab, at most `slab_bytes` of floats at a time, on all workers at once where the source
// allows it. `progress` is told on the calling thread; `stop` is heeded between slabs.
base::Result<Histogram> count_values(VoxelSource& source, const Box& box, const Index3& n,
                                     base::Workers& workers, const Progress& progress = {},
                                     const std::stop_token& stop = {},
                                     std::size_t slab_bytes = std::size_t{16} << 20);

}  // namespace shearwater::volume
