#pragma once
// Reads voxels from a source and quantises them, by all workers at once where the source lets them.

#include <span>
#include <stop_token>
#include <vector>

#include "common/base/result.h"
#include "common/base/workers.h"
#include "common/volume/box.h"
#include "common/volume/mapping.h"
#include "common/volume/quantiser.h"
#include "common/volume/source.h"
#include "renderer/shear/code_volume.h"

namespace shearwater::shear {

// Quantises the voxels of a box, axis 0 fastest, into a volume that holds it.
void quantise(const volume::Quantiser& quantiser, std::span<const float> values, const volume::Box& box,
              CodeVolume& into);

class PlaneReader {
  public:
    // What is given has to outlive it. It holds at most `slab_bytes` of floats (one at the least).
    PlaneReader(volume::VoxelSource& source, const volume::Mapping& mapping, base::Workers& workers,
                std::size_t slab_bytes);

    // How many of a box's planes along axis 2 are best read at once: one, if even that is too large.
    std::int64_t planes_at_once(const volume::Box& box) const;

    // Reads a box into a volume that holds it, every voxel once. Cancelled between chunks.
    base::Status read(const volume::Box& box, CodeVolume& into, const volume::Progress& progress,
                      const std::stop_token& stop);

  private:
    void quantise_chunk(std::span<const float> values, const volume::Box& chunk, CodeVolume& into);

    volume::VoxelSource& source_;
    volume::Quantiser quantiser_;
    base::Workers& workers_;
    std::size_t slab_bytes_;
    std::vector<std::vector<float>> values_;  // of a chunk, for each who reads
};

}  // namespace shearwater::shear
