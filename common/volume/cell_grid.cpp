#include "common/volume/cell_grid.h"

#include <algorithm>

namespace shearwater::volume {

Box CellGrid::within(const Box& box) const {
    Box cells;
    for (std::size_t a = 0; a < 3; ++a) {
        cells.lo[a] = (box.lo[a] + edge - 1) / edge;
        cells.hi[a] = std::max(box.hi[a] == n[a] - 1 ? count(a) : box.hi[a] / edge, cells.lo[a]);
    }
    return cells;
}

}  // namespace shearwater::volume
