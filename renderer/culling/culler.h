#pragma once
// Culling in one process: a whole cube's functions, computed as they are needed, and what a frame may see.

#include "common/base/workers.h"
#include "common/culling/function_store.h"
#include "renderer/shear/brick_volume.h"

namespace shearwater::culling {

// The functions of all of a volume's blocks for a key, from its nodes, or coarser ones from its octants.
FunctionTable functions_of(const shear::BrickVolume& volume, const FunctionKey& key, const BlockGrid& grid,
                           const DirectionGrid& directions, bool from_octants, const view::Vec3& spacing,
                           base::Workers& workers, const std::stop_token& stop = {});

struct Settings {
    std::int64_t block_edge = BlockGrid::default_edge;
    int side = 36;  // of the direction grid
    // What a ray has to have before a block for that not to be seen. The default leaves out less than half a
    // level of 255.
    double threshold = 1 - 1.0 / 510;
    bool operator==(const Settings&) const = default;
};

class Culler {
  public:
    // Of a volume that is a whole cube, and outlives it.
    Culler(const shear::BrickVolume& volume, const view::Vec3& spacing, const Settings& settings);

    // Computes what is missing for a transfer function on a level; returns how many functions of blocks.
    std::int64_t prepare(const view::TransferFunction& tf, int level, base::Workers& workers);

    VisibleBlocks visible(const view::Factorisation& factorisation, const view::TransferFunction& tf,
                          base::Workers& workers);

  private:
    const shear::BrickVolume& volume_;
    view::Vec3 spacing_;
    Settings settings_;
    DirectionGrid directions_;
    FunctionStore store_;
};

}  // namespace shearwater::culling
