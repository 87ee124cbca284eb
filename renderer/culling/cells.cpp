#include "renderer/culling/cells.h"

#include <algorithm>

namespace shearwater::culling {

using volume::Box;
using volume::Index3;

namespace {

Cells of(const shear::BrickVolume& volume, std::int64_t edge) {
    const volume::CellGrid grid{volume.cube(), edge};
    const Box own = grid.within(volume.box());
    return {.grid = grid, .box = own, .known = own, .row = {}};
}

// The halo's cells of so many to an octant's side.
void reach_out(Cells& cells, const shear::Halo& halo, std::int64_t to_octant) {
    for (std::size_t a = 0; a < 3; ++a) {
        cells.known.lo[a] = std::min(cells.box.lo[a], halo.octants().lo[a] * to_octant);
        cells.known.hi[a] =
            std::max(cells.box.hi[a], std::min(halo.octants().hi[a] * to_octant, cells.grid.count(a)));
    }
}

std::int16_t least_of(const shear::OctantRange& range, int bits, const LeastExtinctions& extinctions) {
    const int low = bits - 8;  // bits of codes that the ranges leave out
    return range.min > range.max
               ? std::int16_t{0}
               : extinctions.between(static_cast<std::uint16_t>(range.min << low),
                                     static_cast<std::uint16_t>(((range.max + 1) << low) - 1));
}

// Of an octant around a volume.
std::int16_t least_around(const shear::Halo& halo, const Index3& octant, int bits,
                          const LeastExtinctions& extinctions) {
    for (std::size_t a = 0; a < 3; ++a) {
        if (octant[a] < halo.octants().lo[a] || octant[a] >= halo.octants().hi[a]) {
            return 0;
        }
    }
    const shear::OctantRange& range = halo.at(octant);
    return range.min == 0 ? std::int16_t{0} : least_of(range, bits, extinctions);
}

bool within(const Box& box, std::int64_t y, std::int64_t z) {
    return box.lo[1] <= y && y < box.hi[1] && box.lo[2] <= z && z < box.hi[2];
}

}  // namespace

Cells cells_of_nodes(const shear::BrickVolume& volume, int level, const LeastExtinctions& extinctions) {
    Cells cells = of(volume, std::int64_t{1} << level);
    if (level == 0) {
        reach_out(cells, volume.halo(), shear::Halo::octant);
    }
    cells.row = [&volume, &extinctions, level, box = cells.box](const Index3& first,
                                                                std::span<std::int16_t> units) {
        const shear::CodeVolume& nodes = volume.level(level);
        const auto end = first[0] + static_cast<std::int64_t>(units.size());
        // Those that are its own, in the middle, if any.
        const bool beside = within(box, first[1], first[2]);
        const std::int64_t own = beside ? std::clamp(box.lo[0], first[0], end) : end;
        const std::int64_t own_end = beside ? std::clamp(box.hi[0], own, end) : end;
        const auto at = [&](std::int64_t x) { return static_cast<std::size_t>(x - first[0]); };
        if (own < own_end) {
            least_of_row(nodes, {own, first[1], first[2]}, extinctions,
                         units.subspan(at(own), static_cast<std::size_t>(own_end - own)));
        }
        for (std::int64_t x = first[0]; x < end; ++x) {
            if (x == own && own < own_end) {
                x = own_end;
                if (x >= end) {
                    break;
                }
            }
            constexpr std::int64_t octant = shear::Halo::octant;
            units[at(x)] = least_around(volume.halo(), {x / octant, first[1] / octant, first[2] / octant},
                                        nodes.bits(), extinctions);
        }
    };
    return cells;
}

Cells cells_of_octants(const shear::BrickVolume& volume, const LeastExtinctions& extinctions) {
    constexpr std::int64_t octants = 2;  // of a micro-brick's side
    Cells cells = of(volume, shear::CodeVolume::octant_edge);
    reach_out(cells, volume.halo(), 1);
    cells.row = [&volume, &extinctions, box = cells.box](const Index3& first, std::span<std::int16_t> units) {
        const shear::CodeVolume& voxels = volume.level(0);
        const shear::CodeGrid& grid = voxels.micro_bricks();
        for (std::size_t i = 0; i < units.size(); ++i) {
            const Index3 at{first[0] + static_cast<std::int64_t>(i), first[1], first[2]};
            if (!within(box, at[1], at[2]) || at[0] < box.lo[0] || at[0] >= box.hi[0]) {
                units[i] = least_around(volume.halo(), at, voxels.bits(), extinctions);
                continue;
            }
            Index3 micro_brick;
            std::size_t octant = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                micro_brick[a] = at[a] / octants - grid.first(static_cast<int>(a));
                octant |= static_cast<std::size_t>(at[a] % octants) << a;
            }
            const std::size_t index = grid.index(micro_brick);
            units[i] = grid.ranges()[index].blanks
                           ? std::int16_t{0}
                           : least_of(voxels.octants()[index][octant], voxels.bits(), extinctions);
        }
    };
    return cells;
}

}  // namespace shearwater::culling
