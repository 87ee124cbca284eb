#include "renderer/culling/cells.h"

#include <algorithm>

namespace shearwater::culling {

using volume::Box;
using volume::Index3;

namespace {

// Of so many voxels a side: those that a box owns all of, since what lies across a cut is counted by neither.
Cells of(const Box& box, const Index3& n, std::int64_t voxels) {
    Cells cells{.box = {}, .n = n, .voxels = voxels, .sampled = 1, .ends = 1, .row = {}};
    for (std::size_t a = 0; a < 3; ++a) {
        cells.box.lo[a] = (box.lo[a] + voxels - 1) / voxels;
        cells.box.hi[a] = std::max(box.hi[a] / voxels, cells.box.lo[a]);
    }
    return cells;
}

}  // namespace

Cells cells_of_nodes(const shear::CodeVolume& nodes, int level, const Box& box, const Index3& n,
                     const LeastExtinctions& extinctions) {
    Cells cells = of(box, n, std::int64_t{1} << level);
    // On the first plane, or half-way to the next.
    cells.sampled = 0.5;
    // A ray that comes in from the side has its first sample at most one step further.
    cells.ends = 2;
    cells.row = [&nodes, &extinctions](const Index3& first, std::span<std::int16_t> units) {
        least_of_row(nodes, first, extinctions, units);
    };
    return cells;
}

Cells cells_of_octants(const shear::CodeVolume& voxels, const Box& box, const Index3& n,
                       const LeastExtinctions& extinctions) {
    constexpr std::int64_t octants = 2;  // of a micro-brick's side
    Cells cells = of(box, n, shear::CodeVolume::octant_edge);
    cells.row = [&voxels, &extinctions](const Index3& first, std::span<std::int16_t> units) {
        const shear::CodeGrid& grid = voxels.micro_bricks();
        const int low = voxels.bits() - 8;  // bits of codes that the ranges leave out
        for (std::size_t i = 0; i < units.size(); ++i) {
            const Index3 at{first[0] + static_cast<std::int64_t>(i), first[1], first[2]};
            Index3 micro_brick;
            std::size_t octant = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                micro_brick[a] = at[a] / octants - grid.first(static_cast<int>(a));
                octant |= static_cast<std::size_t>(at[a] % octants) << a;
            }
            const std::size_t index = grid.index(micro_brick);
            const shear::OctantRange& range = voxels.octants()[index][octant];
            const bool blank = grid.ranges()[index].blanks || range.min > range.max;
            units[i] = blank ? std::int16_t{0}
                             : extinctions.between(static_cast<std::uint16_t>(range.min << low),
                                                   static_cast<std::uint16_t>(((range.max + 1) << low) - 1));
        }
    };
    return cells;
}

}  // namespace shearwater::culling
