#include "common/wcs/sample.h"

#include <algorithm>
#include <cmath>

namespace shearwater::wcs {

namespace {

constexpr int probes = 5;  // along each axis, to see on which of them values depend
constexpr double tolerance = 0.02, independent = 1e-3;  // of what a voxel makes

std::vector<Place> places_of(const std::array<int, 3>& nodes, const volume::Index3& n) {
    const auto at = [&](std::size_t a, int k) {
        return nodes[a] > 1 ? static_cast<double>(n[a] - 1) * k / (nodes[a] - 1)
                            : static_cast<double>(n[a] - 1) / 2;
    };
    std::vector<Place> places;
    for (int z = 0; z < nodes[2]; ++z) {
        for (int y = 0; y < nodes[1]; ++y) {
            for (int x = 0; x < nodes[0]; ++x) {
                places.push_back({at(0, x), at(1, y), at(2, z)});
            }
        }
    }
    return places;
}

bool fill(Axis& axis, const volume::Index3& n, const Formula& formula) {
    axis.values = formula(places_of(axis.nodes, n));
    for (double& value : axis.values) {
        if (std::abs(value) > Axis::max_size) {
            value = std::nan("");
        }
    }
    return std::ranges::any_of(axis.values, [](double value) { return std::isfinite(value); });
}

// Of neighbouring nodes along one of the cube's axes, how much a voxel makes.
struct Change {
    double mean = 0, most = 0;
};
Change change_along(const Axis& axis, std::size_t along, const volume::Index3& n) {
    std::size_t stride = 1;
    for (std::size_t a = 0; a < along; ++a) {
        stride *= static_cast<std::size_t>(axis.nodes[a]);
    }
    const auto nodes = static_cast<std::size_t>(axis.nodes[along]);
    const double voxels = static_cast<double>(n[along] - 1) / static_cast<double>(nodes - 1);
    Change change;
    double counted = 0;
    for (std::size_t i = 0; i < axis.values.size(); ++i) {
        if (i / stride % nodes + 1 == nodes) {
            continue;
        }
        const double d = std::abs(difference(axis, axis.values[i], axis.values[i + stride])) / voxels;
        if (std::isfinite(d)) {
            change.mean += d;
            change.most = std::max(change.most, d);
            ++counted;
        }
    }
    change.mean = counted > 0 ? change.mean / counted : 0;
    return change;
}

// Every so many-th node along the axes that have several.
Axis thinned(const Axis& fine, int stride) {
    Axis coarse = fine;
    coarse.values.clear();
    for (int& nodes : coarse.nodes) {
        nodes = nodes > 1 ? (nodes - 1) / stride + 1 : 1;
    }
    for (int z = 0; z < coarse.nodes[2]; ++z) {
        for (int y = 0; y < coarse.nodes[1]; ++y) {
            for (int x = 0; x < coarse.nodes[0]; ++x) {
                const int row = z * stride * fine.nodes[1] + y * stride;
                coarse.values.push_back(
                    fine.values[static_cast<std::size_t>(row * fine.nodes[0] + x * stride)]);
            }
        }
    }
    return coarse;
}

bool agree(const Axis& coarse, const Axis& fine, const volume::Index3& n, double within) {
    const std::vector<Place> places = places_of(fine.nodes, n);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double apart = std::abs(difference(fine, fine.values[i], value_at(coarse, n, places[i])));
        if (std::isfinite(fine.values[i]) && !(apart <= within)) {
            return false;
        }
    }
    return true;
}

}  // namespace

bool sample(Axis& axis, int along, const volume::Index3& n, const Formula& formula) {
    Axis fine = axis;
    fine.nodes = {probes, probes, probes};
    if (!fill(fine, n, formula)) {
        return false;
    }
    const auto own = static_cast<std::size_t>(along);
    const double per_voxel = change_along(fine, own, n).mean;
    if (!(per_voxel > 0)) {
        return false;
    }
    int depends = 0;
    std::array<bool, 3> on{};
    for (std::size_t a = 0; a < 3; ++a) {
        on[a] = a == own || change_along(fine, a, n).most > independent * per_voxel;
        depends += on[a] ? 1 : 0;
    }
    const int most = depends < 3 ? Axis::max_nodes : 9;
    for (std::size_t a = 0; a < 3; ++a) {
        fine.nodes[a] = on[a] ? most : 1;
    }
    if (!fill(fine, n, formula)) {
        return false;
    }
    int stride = most - 1;
    while (stride > 1 && !agree(thinned(fine, stride), fine, n, tolerance * per_voxel)) {
        stride /= 2;
    }
    axis = thinned(fine, stride);
    return true;
}

}  // namespace shearwater::wcs
