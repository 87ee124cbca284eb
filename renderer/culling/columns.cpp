#include "renderer/culling/columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/base/check.h"
#include "common/culling/rates.h"
#include "renderer/culling/column_kernel.h"

namespace shearwater::culling {

using volume::Box;
using volume::Index3;

namespace {

// All of a sub-volume's functions share.
struct Task {
    const Cells& cells;
    const DirectionGrid& directions;
    std::int64_t edge;  // of a block, in cells
    FunctionTable& table;
};

// The sheaves of an axis through so many of a block's layers.
using Sheaves = std::vector<std::optional<ColumnSheaf>>;

Sheaves sheaves_of(const Task& task, int axis, std::int64_t first, std::int64_t count) {
    Sheaves sheaves;
    for (int cell = 0; cell < task.directions.cells(); ++cell) {
        const auto slopes = task.directions.slopes(cell, axis);
        sheaves.push_back(
            slopes ? std::optional(ColumnSheaf(*slopes, static_cast<int>(first), static_cast<int>(count),
                                               static_cast<double>(task.edge) / 2))
                   : std::nullopt);
    }
    return sheaves;
}

// A row of blocks along u, with as much around it as its lines reach.
class Strip {
  public:
    // Of the blocks at v and w along an axis.
    Strip(const Task& task, int axis, std::int64_t block_v, std::int64_t block_w)
        : task_(task),
          u_(static_cast<std::size_t>((axis + 1) % 3)),
          v_(static_cast<std::size_t>((axis + 2) % 3)),
          w_(static_cast<std::size_t>(axis)),
          block_v_(block_v),
          block_w_(block_w) {
        constexpr std::int64_t around = ColumnSheaf::farthest;
        layers_ = within(task.cells.known, w_, block_w * task.edge, (block_w + 1) * task.edge);
        rows_ = within(task.cells.box, v_, block_v * task.edge, (block_v + 1) * task.edge);
        if (empty()) {
            return;
        }
        const Range filled = within(task.cells.known, v_, rows_.lo - around, rows_.hi + around);
        row_ = task.cells.known.cells(static_cast<int>(u_)) + 2 * around + column_padding;
        layer_ = row_ * (rows_.hi - rows_.lo + 2 * around);
        units_.assign(static_cast<std::size_t>(layer_ * (layers_.hi - layers_.lo) + column_padding), 0);
        leave_out(around);
        fill(filled);
    }

    // A coarse level's cells may all lie across the sub-volume's faces.
    bool empty() const { return layers_.lo >= layers_.hi || rows_.lo >= rows_.hi; }
    std::int64_t first_layer() const { return layers_.lo - block_w_ * task_.edge; }
    std::int64_t layers() const { return layers_.hi - layers_.lo; }

    // Lowers the codes of all blocks of the strip to what its axis' sheaves say.
    void find(const Sheaves& sheaves) {
        const Box& blocks = task_.table.blocks;
        const auto count = task_.table.block_count();
        for (std::int64_t b = blocks.lo[u_]; b < blocks.hi[u_]; ++b) {
            const Range columns = within(task_.cells.box, u_, b * task_.edge, (b + 1) * task_.edge);
            Index3 at;
            at[u_] = b - blocks.lo[u_];
            at[v_] = block_v_ - blocks.lo[v_];
            at[w_] = block_w_ - blocks.lo[w_];
            const std::int64_t index = (at[2] * blocks.cells(1) + at[1]) * blocks.cells(0) + at[0];
            const bool none = clear_ || columns.lo >= columns.hi;
            const ColumnCells cells{
                .first = none ? nullptr : &units_[offset(columns.lo, rows_.lo, layers_.lo)],
                .row = row_,
                .layer = layer_,
                .bundles_u = static_cast<int>(columns.hi - columns.lo),
                .bundles_v = static_cast<int>(rows_.hi - rows_.lo)};
            for (std::size_t cell = 0; cell < sheaves.size(); ++cell) {
                if (sheaves[cell]) {
                    std::uint8_t& code = task_.table.codes[cell * count + static_cast<std::size_t>(index)];
                    if (code > 0) {
                        code = std::min(code, none ? std::uint8_t{0} : code_of(cells, *sheaves[cell]));
                    }
                }
            }
        }
    }

  private:
    struct Range {
        std::int64_t lo, hi;
    };

    static Range within(const Box& box, std::size_t axis, std::int64_t lo, std::int64_t hi) {
        return {std::max(lo, box.lo[axis]), std::min(hi, box.hi[axis])};
    }
    std::size_t offset(std::int64_t u, std::int64_t v, std::int64_t w) const {
        constexpr std::int64_t around = ColumnSheaf::farthest;
        return static_cast<std::size_t>((w - layers_.lo) * layer_ + (v - rows_.lo + around) * row_ + u -
                                        task_.cells.known.lo[u_] + around);
    }
    // Were all layers of the block there.
    std::uint8_t code_of(const ColumnCells& cells, const ColumnSheaf& sheaf) const {
        const double depth = least_depth(cells, sheaf) * value_unit;
        const std::int64_t voxels = task_.cells.grid.edge, first = block_w_ * task_.edge * voxels;
        const std::int64_t all = std::min(task_.edge * voxels, task_.cells.grid.n[w_] - 1 - first);
        return code_below(depth * static_cast<double>(voxels) / static_cast<double>(all));
    }

    // No line is looked at that leaves the cube by its sides: what is beyond counts for nothing.
    void leave_out(std::int64_t around) {
        constexpr std::uint16_t none = 65535;
        const Range u{task_.cells.known.lo[u_] - around, task_.cells.known.hi[u_] + around};
        for (std::int64_t w = layers_.lo; w < layers_.hi; ++w) {
            for (std::int64_t v = rows_.lo - around; v < rows_.hi + around; ++v) {
                std::uint16_t* const row = &units_[offset(u.lo, v, w)];
                if (v < 0 || v >= task_.cells.grid.count(v_)) {
                    std::fill(row, row + (u.hi - u.lo), none);
                    continue;
                }
                if (u.lo < 0) {
                    std::fill(row, row - u.lo, none);
                }
                if (const std::int64_t end = task_.cells.grid.count(u_); u.hi > end) {
                    std::fill(row + (end - u.lo), row + (u.hi - u.lo), none);
                }
            }
        }
    }

    void fill(const Range& filled) {
        Box box;
        box.lo[u_] = task_.cells.known.lo[u_];
        box.hi[u_] = task_.cells.known.hi[u_];
        box.lo[v_] = filled.lo;
        box.hi[v_] = filled.hi;
        box.lo[w_] = layers_.lo;
        box.hi[w_] = layers_.hi;
        std::vector<std::int16_t> row(static_cast<std::size_t>(box.cells(0)));
        Index3 steps;
        steps[u_] = 1;
        steps[v_] = row_;
        steps[w_] = layer_;
        // A ray's first sample at the cube's end may stand for half a step, and so its last.
        const std::int64_t voxels = task_.cells.grid.edge, last = task_.cells.grid.count(w_) - 1;
        const std::int64_t voxels_of_last = task_.cells.grid.n[w_] - 1 - last * voxels;
        const auto counted = [&](const Index3& at, std::int64_t units) {
            return at[w_] == last ? units * voxels_of_last / (2 * voxels) : at[w_] == 0 ? units / 2 : units;
        };
        for (std::int64_t z = box.lo[2]; z < box.hi[2]; ++z) {
            for (std::int64_t y = box.lo[1]; y < box.hi[1]; ++y) {
                task_.cells.row({box.lo[0], y, z}, row);
                Index3 first{box.lo[0], y, z};
                std::uint16_t* to = &units_[offset(first[u_], first[v_], first[w_])];
                for (std::int64_t x = box.lo[0]; x < box.hi[0]; ++x, to += steps[0]) {
                    const std::int16_t units = row[static_cast<std::size_t>(x - box.lo[0])];
                    *to = static_cast<std::uint16_t>(counted({x, y, z}, units));
                    clear_ = clear_ && units == 0;
                }
            }
        }
    }

    const Task& task_;
    std::size_t u_, v_, w_;
    std::int64_t block_v_, block_w_;
    Range layers_{}, rows_{};
    std::int64_t row_ = 0, layer_ = 0;  // strides
    std::vector<std::uint16_t> units_;
    bool clear_ = true;
};

}  // namespace

FunctionTable column_functions(const Cells& cells, const BlockGrid& grid, const Box& box,
                               const DirectionGrid& directions, base::Workers& workers,
                               const std::stop_token& stop) {
    FunctionTable table{.blocks = grid.blocks_of(box), .side = directions.side(), .codes = {}};
    const Task task{cells, directions, grid.edge() / cells.grid.edge, table};
    const bool none = task.edge == 0 || cells.box.cells(0) * cells.box.cells(1) * cells.box.cells(2) == 0;
    table.codes.assign(table.block_count() * static_cast<std::size_t>(directions.cells()),
                       static_cast<std::uint8_t>(none ? 0 : most_code));
    if (none) {
        return table;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const auto v = static_cast<std::size_t>((axis + 2) % 3), w = static_cast<std::size_t>(axis);
        const std::int64_t across = table.blocks.hi[v] - table.blocks.lo[v];
        const std::int64_t along = table.blocks.hi[w] - table.blocks.lo[w];
        const Sheaves whole = sheaves_of(task, axis, 0, task.edge);
        const bool all = workers.for_each(
            across * along,
            [&](std::int64_t part) {
                Strip strip(task, axis, table.blocks.lo[v] + part % across,
                            table.blocks.lo[w] + part / across);
                strip.find(strip.empty() || strip.layers() == task.edge
                               ? whole
                               : sheaves_of(task, axis, strip.first_layer(), strip.layers()));
            },
            stop);
        if (!all) {
            return {};
        }
    }
    return table;
}

}  // namespace shearwater::culling
