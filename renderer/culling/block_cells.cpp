#include "renderer/culling/block_cells.h"

#include <algorithm>
#include <span>

#include "common/base/check.h"

namespace shearwater::culling {

BlockCells::BlockCells(const Cells& cells, const volume::Box& box) {
    base::check(cells.box.contains(box), "a block's cells are the sub-volume's");
    for (int axis = 0; axis < 3; ++axis) {
        base::check(0 < box.cells(axis) && box.cells(axis) <= max_edge, "a block has 1 to 32 cells a side");
        const auto a = static_cast<std::size_t>(axis);
        counts[a] = static_cast<int>(box.cells(axis));
        whole[a] = static_cast<int>(std::min(box.hi[a], cells.grid.count_uncut(a)) - box.lo[a]);
    }
    const auto length = static_cast<std::size_t>(counts[0]);
    units.resize(length * static_cast<std::size_t>(counts[1]) * static_cast<std::size_t>(counts[2]));
    std::span<std::int16_t> left = units;
    for (std::int64_t z = box.lo[2]; z < box.hi[2]; ++z) {
        for (std::int64_t y = box.lo[1]; y < box.hi[1]; ++y) {
            cells.row({box.lo[0], y, z}, left.first(length));
            left = left.subspan(length);
        }
    }
    const auto [min, max] = std::minmax_element(units.begin(), units.end());
    least = *min;
    greatest = *max;
}

}  // namespace shearwater::culling
