#include "common/wcs/axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shearwater::wcs {

namespace {

constexpr double turn = 360;
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

// The two nodes along an axis between which a place lies, and how far it is from the first to the second.
struct Between {
    std::size_t lo = 0, hi = 0;
    double share = 0;
};

Between between(int nodes, std::int64_t n, double voxel) {
    if (nodes < 2 || n < 2 || !std::isfinite(voxel)) {
        return {};
    }
    const double at = voxel / static_cast<double>(n - 1) * (nodes - 1);
    const double lo = std::clamp(std::floor(at), 0.0, static_cast<double>(nodes - 2));
    // A little beyond the cube its ends are prolonged.
    return {static_cast<std::size_t>(lo), static_cast<std::size_t>(lo) + 1, std::clamp(at - lo, -1.0, 2.0)};
}

base::Error refused(const std::string& detail) {
    return base::error(base::Code::invalid_argument, "world coordinates", detail);
}

}  // namespace

double difference(const Axis& axis, double from, double to) {
    const double d = to - from;
    return axis.circle ? d - turn * std::round(d / turn) : d;
}

double value_at(const Axis& axis, const volume::Index3& n, const Place& place) {
    if (!axis.known()) {
        return nowhere;
    }
    std::array<Between, 3> cell;
    for (std::size_t a = 0; a < 3; ++a) {
        cell[a] = between(axis.nodes[a], n[a], place[a]);
    }
    const auto node = [&](std::size_t x, std::size_t y, std::size_t z) {
        const auto nx = static_cast<std::size_t>(axis.nodes[0]), ny = static_cast<std::size_t>(axis.nodes[1]);
        return axis.values[(z * ny + y) * nx + x];
    };
    const double first = node(cell[0].lo, cell[1].lo, cell[2].lo);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        std::array<std::size_t, 3> at{};
        for (std::size_t a = 0; a < 3; ++a) {
            const bool upper = (corner >> a & 1) != 0;
            weight *= upper ? cell[a].share : 1 - cell[a].share;
            at[a] = upper ? cell[a].hi : cell[a].lo;
        }
        if (weight == 0) {
            continue;
        }
        const double apart = difference(axis, first, node(at[0], at[1], at[2]));
        // Around a pole a circle's nodes say nothing of what is between them.
        if (axis.circle && !(std::abs(apart) <= turn / 4)) {
            return nowhere;
        }
        sum += weight * apart;
    }
    const double value = first + sum;
    return axis.circle ? value - turn * std::floor(value / turn) : value;
}

bool rises(const Axis& axis, int along, const volume::Index3& n) {
    Place before;
    for (std::size_t a = 0; a < 3; ++a) {
        before[a] = static_cast<double>(n[a] - 1) / 2;
    }
    Place after = before;
    before[static_cast<std::size_t>(along)] -= 0.5;
    after[static_cast<std::size_t>(along)] += 0.5;
    return !(difference(axis, value_at(axis, n, before), value_at(axis, n, after)) < 0);
}

Axis voxel_axis(int along, const volume::Index3& n) {
    const auto a = static_cast<std::size_t>(along);
    constexpr std::array labels{"x", "y", "z"};
    Axis axis{.name = labels.at(a),
              .label = labels.at(a),
              .unit = "",
              .values = {0, static_cast<double>(n[a] - 1)}};
    axis.nodes[a] = 2;
    return axis;
}

Axis shown_axis(const Axes& axes, int along, const volume::Index3& n) {
    const Axis& axis = axes[static_cast<std::size_t>(along)];
    return axis.known() ? axis : voxel_axis(along, n);
}

base::Status validate(const Axis& axis, int along) {
    if (!axis.known()) {
        return {};
    }
    std::size_t count = 1;
    for (const int nodes : axis.nodes) {
        if (nodes < 1 || nodes > Axis::max_nodes) {
            return refused("1 to 33 nodes are wanted along every axis");
        }
        count *= static_cast<std::size_t>(nodes);
    }
    if (count > Axis::max_values || count != axis.values.size()) {
        return refused("a value for each node is wanted, of which there are not too many");
    }
    if (axis.nodes[static_cast<std::size_t>(along)] < 2) {
        return refused("two nodes at the least are wanted along the axis itself");
    }
    if (axis.name.empty() || axis.label.empty()) {
        return refused("an axis has no name");
    }
    const bool sexagesimal = axis.notation != Notation::plain;
    for (const double value : axis.values) {
        const double most = axis.circle || sexagesimal ? 2 * turn : Axis::max_size;
        if (std::abs(value) > most) {
            return refused("a value is too large");
        }
    }
    return {};
}

}  // namespace shearwater::wcs
