#pragma once
// Culling in one process: a whole cube's functions, computed as they are needed, and what a frame may see.

#include "common/base/workers.h"
#include "common/culling/function_store.h"
#include "renderer/shear/brick_volume.h"

namespace shearwater::culling {

// The functions of all of a volume's blocks for a key, from its nodes, or coarser ones from its octants.
FunctionTable functions_of(const shear::BrickVolume& volume, const FunctionKey& key, const BlockGrid& grid,
                           const DirectionGrid& directions, bool from_octants, base::Workers& workers,
                           const std::stop_token& stop = {});

class Culler {
  public:
    // Of a volume that is a whole cube, and outlives it.
    Culler(const shear::BrickVolume& volume, const view::Vec3& spacing,
           std::int64_t block_edge = BlockGrid::default_edge, int side = DirectionGrid::default_side);

    // Computes what is missing for a transfer function on a level; returns how many functions of blocks.
    std::int64_t prepare(const view::TransferFunction& tf, Kind kind, int level, base::Workers& workers);

    // What has been prepared,
    const FunctionStore& functions() const { return store_; }
    // and what may be seen by it.
    VisibleBlocks visible(const view::Factorisation& factorisation, const view::TransferFunction& tf,
                          const Settings& settings, base::Workers& workers);

  private:
    const shear::BrickVolume& volume_;
    view::Vec3 spacing_;
    DirectionGrid directions_;
    FunctionStore store_;
};

}  // namespace shearwater::culling
