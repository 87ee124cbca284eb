#include "renderer/shear/halo.h"

#include <algorithm>

#include "common/volume/cell_grid.h"

namespace shearwater::shear {

using volume::Box;

Halo::Halo(const Box& box, const Box& passing, const volume::Index3& n) {
    const volume::CellGrid grid{n, octant};
    const Box known = grid.within(passing);
    own_ = grid.within(box);
    bool around = false;
    std::int64_t count = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        octants_.lo[a] = std::max(own_.lo[a] - width, known.lo[a]);
        octants_.hi[a] = std::max(std::min(own_.hi[a] + width, known.hi[a]), octants_.lo[a]);
        around = around || octants_.lo[a] < own_.lo[a] || octants_.hi[a] > own_.hi[a];
        count *= octants_.hi[a] - octants_.lo[a];
    }
    if (around) {
        ranges_.resize(static_cast<std::size_t>(count));
    } else {
        octants_ = own_;
    }
}

void Halo::add(const CodeVolume& voxels, std::int64_t first, std::int64_t end, base::Workers& workers) {
    if (ranges_.empty()) {
        return;
    }
    for (std::int64_t z = first; z < end; ++z) {
        // A plane on the border of two layers of octants is of both.
        for (std::int64_t layer = z % octant == 0 ? z / octant - 1 : z / octant; layer <= z / octant;
             ++layer) {
            if (layer < octants_.lo[2] || layer >= octants_.hi[2]) {
                continue;
            }
            workers.for_each(octants_.hi[1] - octants_.lo[1], [&](std::int64_t row) {
                voxels.bits() == 8 ? add_row<std::uint8_t>(voxels, z, octants_.lo[1] + row, layer)
                                   : add_row<std::uint16_t>(voxels, z, octants_.lo[1] + row, layer);
            });
        }
    }
}

template <class Code>
void Halo::add_row(const CodeVolume& voxels, std::int64_t z, std::int64_t octant_y, std::int64_t octant_z) {
    const bool beside =
        own_.lo[1] <= octant_y && octant_y < own_.hi[1] && own_.lo[2] <= octant_z && octant_z < own_.hi[2];
    for (std::int64_t x = octants_.lo[0]; x < octants_.hi[0]; ++x) {
        if (beside && x == own_.lo[0]) {
            x = own_.hi[0];
            if (x >= octants_.hi[0]) {
                return;
            }
        }
        OctantRange& range = ranges_[index({x, octant_y, octant_z})];
        const std::int64_t last_x = std::min((x + 1) * octant, voxels.box().hi[0]);
        const std::int64_t last_y = std::min((octant_y + 1) * octant, voxels.box().hi[1]);
        for (std::int64_t y = octant_y * octant; y <= last_y; ++y) {
            const Code* const row = &voxels.codes<Code>()[voxels.offset({x * octant, y, z})];
            for (std::int64_t i = 0; i <= last_x - x * octant; ++i) {
                // A valid code of 16 bits may begin with 0: it counts as blank, which is as safe.
                const auto lead = static_cast<std::uint8_t>(row[i] >> (8 * (sizeof(Code) - 1)));
                range.min = std::min(range.min, lead);
                range.max = std::max(range.max, lead);
            }
        }
    }
}

}  // namespace shearwater::shear
