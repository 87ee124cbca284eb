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

// On the planes from `near` to `far`, counted in cells from the plane on which they are in that cell.
inline Reach reach_of(const Interval& slopes, double near, double far) {
    const auto [lo, hi] = std::minmax({slopes.lo * near, slopes.lo * far, slopes.hi * near, slopes.hi * far});
    return {static_cast<int>(std::floor(lo)), static_cast<int>(std::ceil(hi))};
}

}  // namespace shearwater::culling
