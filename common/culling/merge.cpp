#include "common/culling/merge.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "common/culling/rates.h"
#include "common/volume/cell_grid.h"

namespace shearwater::culling {

using volume::Box;
using volume::Index3;

namespace {

// A sub-volume's part of a block.
struct Part {
    const SubVolume* of;
    Box known;  // voxels of its cells there
    std::size_t index;

    double rate(std::size_t direction) const {
        return rate_of(of->table->codes[direction * of->table->block_count() + index]);
    }
};

// A sub-volume, and which of the cells that its table is made from it has.
struct Known {
    const SubVolume* of;
    Box cells;
};

std::vector<Known> known_of(const BlockGrid& grid, const std::vector<SubVolume>& sub_volumes) {
    std::vector<Known> known;
    for (const SubVolume& of : sub_volumes) {
        known.push_back({&of, volume::CellGrid{grid.voxels(), of.cell}.within(of.box)});
    }
    return known;
}

// Those that a block has, with what of the block they say nothing about left out.
std::vector<Part> parts_of(const Index3& at, const Box& block, const std::vector<Known>& all) {
    std::vector<Part> parts;
    for (const auto& [sub_volume, cells] : all) {
        const Box& blocks = sub_volume->table->blocks;
        const std::int64_t edge = sub_volume->cell;
        Part part{sub_volume, {}, 0};
        bool meets = true;
        Index3 offset;
        for (std::size_t a = 0; a < 3; ++a) {
            meets = meets && blocks.lo[a] <= at[a] && at[a] < blocks.hi[a];
            offset[a] = at[a] - blocks.lo[a];
            part.known.lo[a] = std::max(block.lo[a], cells.lo[a] * edge);
            part.known.hi[a] = std::min(block.hi[a], cells.hi[a] * edge);
            meets = meets && part.known.lo[a] < part.known.hi[a];
        }
        if (meets) {
            part.index = static_cast<std::size_t>(
                (offset[2] * blocks.cells(1) + offset[1]) * blocks.cells(0) + offset[0]);
            parts.push_back(part);
        }
    }
    return parts;
}

// Of lines along an axis: the least over all columns of the most that is said of one.
double least_of_columns(const std::vector<Part>& parts, const Box& block, std::size_t axis,
                        std::size_t direction) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::vector<std::int64_t> u_edges{block.lo[u]}, v_edges{block.lo[v]};
    for (const Part& part : parts) {
        for (const std::int64_t edge : {part.known.lo[u], part.known.hi[u]}) {
            u_edges.push_back(edge);
        }
        for (const std::int64_t edge : {part.known.lo[v], part.known.hi[v]}) {
            v_edges.push_back(edge);
        }
    }
    double least = std::numeric_limits<double>::max();
    for (const std::int64_t at_u : u_edges) {
        for (const std::int64_t at_v : v_edges) {
            if (at_u >= block.hi[u] || at_v >= block.hi[v]) {
                continue;
            }
            double most = 0;
            for (const Part& part : parts) {
                const bool has = part.known.lo[u] <= at_u && at_u < part.known.hi[u] &&
                                 part.known.lo[v] <= at_v && at_v < part.known.hi[v];
                most = std::max(most, has ? part.rate(direction) : 0);
            }
            least = std::min(least, most);
        }
    }
    return least;
}

}  // namespace

FunctionTable merged(const BlockGrid& grid, const DirectionGrid& directions, Footprint footprint,
                     const std::vector<SubVolume>& sub_volumes) {
    const Index3& counts = grid.counts();
    FunctionTable table{.blocks = {{0, 0, 0}, counts}, .side = directions.side(), .codes = {}};
    const auto sides = static_cast<std::size_t>(directions.cells());
    const std::vector<Known> known = known_of(grid, sub_volumes);
    table.codes.assign(grid.size() * sides, 0);
    for (std::size_t index = 0; index < grid.size(); ++index) {
        const Index3 at = grid.at(index);
        const Box block = grid.box(at);
        const std::vector<Part> parts = parts_of(at, block, known);
        if (parts.empty()) {
            continue;
        }
        std::int64_t said = 0;
        for (const Part& part : parts) {
            said += part.known.cells(0) * part.known.cells(1) * part.known.cells(2);
        }
        const bool all_said = said == block.cells(0) * block.cells(1) * block.cells(2);
        for (std::size_t direction = 0; direction < sides; ++direction) {
            std::uint8_t& code = table.codes[direction * grid.size() + index];
            if (parts.size() == 1 && all_said) {
                const FunctionTable& of = *parts[0].of->table;
                code = of.codes[direction * of.block_count() + parts[0].index];
            } else if (footprint == Footprint::block) {
                double least = all_said ? greatest_rate : 0;
                for (const Part& part : parts) {
                    least = std::min(least, part.rate(direction));
                }
                code = code_below(least);
            } else {
                double least = std::numeric_limits<double>::max();
                for (int axis = 0; axis < 3; ++axis) {
                    if (directions.slopes(static_cast<int>(direction), axis)) {
                        least = std::min(
                            least, least_of_columns(parts, block, static_cast<std::size_t>(axis), direction));
                    }
                }
                code = code_below(least);
            }
        }
    }
    return table;
}

}  // namespace shearwater::culling
