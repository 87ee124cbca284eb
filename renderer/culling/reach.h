#pragma once
// Where lines of some slopes lie that pass through one cell.

#include <algorithm>
#include <cmath>

#include "common/culling/direction_grid.h"

namespace shearwater::culling {

// Cells, counted from that one.
struct Reach {
    int first, last;
};

// In the layer of cells from the plane `near` to the next, counted in cells from the plane on which they are
// in that cell: samples lie on the one plane or half-way to the other, and segments reach across it.
inline Reach reach_of(const Interval& slopes, double near) {
    const double far = near + 1;
    const auto [lo, hi] = std::minmax({slopes.lo * near, slopes.lo * far, slopes.hi * near, slopes.hi * far});
    return {static_cast<int>(std::floor(lo)), static_cast<int>(std::ceil(hi))};
}

}  // namespace shearwater::culling
