#include "common/volume/interpolate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/check.h"

namespace shearwater::volume {

base::Result<double> value_at(VoxelSource& source, const Index3& n, const std::array<double, 3>& at) {
    Box cell;
    std::array<double, 3> fraction{};
    for (std::size_t a = 0; a < 3; ++a) {
        base::check(at[a] >= 0 && at[a] <= static_cast<double>(n[a] - 1), "the point is in the cube");
        cell.lo[a] = std::min(static_cast<std::int64_t>(at[a]), n[a] - 2);
        cell.hi[a] = cell.lo[a] + 1;
        fraction[a] = at[a] - static_cast<double>(cell.lo[a]);
    }
    std::array<float, 8> corners{};
    if (const auto read = source.read(cell, corners); !read) {
        return read.error();
    }
    double sum = 0, valid = 0;
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
        double weight = 1;
        for (std::size_t a = 0; a < 3; ++a) {
            weight *= (corner >> a & 1U) != 0 ? fraction[a] : 1 - fraction[a];
        }
        if (std::isfinite(corners[corner])) {
            sum += weight * static_cast<double>(corners[corner]);
            valid += weight;
        }
    }
    return valid < 0.5 ? std::numeric_limits<double>::quiet_NaN() : sum / valid;
}

}  // namespace shearwater::volume
