#pragma once
// A leaf's sub-volume as quantised codes: its voxels, and the coarser levels of them that stand in where
// voxels are smaller than pixels. What is drawn is counted by bricks of 32^3 cells.

#include <stop_token>
#include <vector>

#include "common/base/result.h"
#include "common/base/workers.h"
#include "common/volume/box.h"
#include "common/volume/mapping.h"
#include "common/volume/source.h"
#include "renderer/shear/code_volume.h"
#include "renderer/shear/halo.h"

namespace shearwater::shear {

class BrickVolume {
  public:
    static constexpr std::int64_t edge = 32;

    // Reads the planes of `box` from a source, and those beyond that its coarser levels are made from
    // (volume::nodes_to_make), slab by slab, and quantises them in parallel. Peak memory is what it holds at
    // last, the codes of a slab, and `slab_bytes` of floats. Cancelled between parts of a slab.
    static base::Result<BrickVolume> load(volume::VoxelSource& source, const volume::Box& box,
                                          const volume::Index3& n, const volume::Mapping& mapping,
                                          base::Workers& workers, const volume::Progress& progress = {},
                                          const std::stop_token& stop = {},
                                          std::size_t slab_bytes = std::size_t{32} << 20);

    // Only one level of it, from all of its nodes: the finer ones are empty, and cannot be drawn.
    static BrickVolume of_level(int level, CodeVolume nodes, const volume::Box& box, const volume::Index3& n,
                                const volume::Mapping& mapping, base::Workers& workers);

    // Keeps one copy of its codes at every level, or two, so that faces across axis 0 are drawn as fast as
    // others (CodeVolume); cancelled, or too_large where there is no memory for as much again.
    base::Status keep_copies(int copies, base::Workers& workers, const std::stop_token& stop = {});

    const volume::Box& box() const { return box_; }
    const volume::Index3& cube() const { return n_; }  // voxels of the whole cube
    const volume::Mapping& mapping() const { return mapping_; }
    std::size_t bytes() const;

    // Level 0, the voxels, to volume::coarsest_level(cube()): those between which the box's samples
    // lie and a margin (volume::nodes_kept).
    int levels() const { return static_cast<int>(levels_.size()); }
    const CodeVolume& level(int level) const { return levels_[static_cast<std::size_t>(level)]; }
    // Of its voxels.
    const CodeGrid& bricks() const { return bricks_; }
    // Of each of them, the codes that the segments may meet that begin in it.
    std::span<const CodeRange> reaches() const { return reaches_; }

    // What lies around it, if it is loaded from its voxels.
    const Halo& halo() const { return halo_; }

  private:
    // Finds out what its levels hold; false if stopped before.
    bool survey(base::Workers& workers, const std::stop_token& stop);
    // Fills in the bricks from the micro-bricks of a level.
    void summarise(int level);

    volume::Box box_;
    volume::Index3 n_{};
    volume::Mapping mapping_;
    std::vector<CodeVolume> levels_;
    CodeGrid bricks_;
    std::vector<CodeRange> reaches_;
    Halo halo_;
};

}  // namespace shearwater::shear
