#pragma once
// Makes a sub-volume's levels from its voxels as they pass, plane by plane along axis 2. What a level is made
// from but does not keep, nodes beyond the box on every side (volume/levels.h), is there only while it
// passes:
//
//   level 1   . .|k k k k k k|. .         a window of a few planes moves along each level; what it holds of
//               [^ ^]->                   the nodes kept is copied, and coarser nodes are made from it
//   level 0   . . .|k k k k k k k k k k k|. . .
//                   [. . . .]->

#include <cstdint>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "common/base/workers.h"
#include "common/volume/box.h"
#include "renderer/shear/code_volume.h"
#include "renderer/shear/halo.h"

namespace shearwater::shear {

class LevelBuilder {
  public:
    // Of a box of a cube of n voxels, in codes of so many bits; `planes` of voxels pass at a time.
    // std::bad_alloc where there is no room.
    LevelBuilder(const volume::Box& box, const volume::Index3& n, int bits, std::int64_t planes);

    // All voxels that will pass.
    const volume::Box& voxels() const { return flows_.front().nodes; }
    // Those that are to pass next, if any are left, to be filled into the window; then rise().
    std::optional<volume::Box> next() const;
    CodeVolume& window() { return flows_.front().window; }

    // Takes them up the levels; false if stopped before, and of no use then.
    bool rise(base::Workers& workers, const std::stop_token& stop);

    // Once nothing is left: the codes of each level, volume::nodes_kept of them; and what lies around the
    // box.
    std::vector<CodeVolume> take_levels() { return std::move(levels_); }
    Halo take_halo() { return std::move(halo_); }

    // Of the levels and the windows.
    std::size_t bytes() const;

  private:
    struct Flow {
        volume::Box nodes;  // of the level that are needed
        CodeVolume window;  // some planes of them
        std::int64_t end;   // of the planes that have come
    };

    std::int64_t ready(std::size_t level) const;
    bool keep(std::size_t level, std::int64_t from, base::Workers& workers, const std::stop_token& stop);

    volume::Index3 n_;
    std::int64_t planes_;
    std::vector<Flow> flows_;
    std::vector<CodeVolume> levels_;
    Halo halo_;
};

}  // namespace shearwater::shear
