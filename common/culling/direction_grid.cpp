#include "common/culling/direction_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/base/check.h"

namespace shearwater::culling {

namespace {

// Beyond what is computed here: an interval that is a little too long still holds for its lines.
constexpr double angle_slack = 1e-9;

Interval hull(std::initializer_list<double> values) {
    return {std::min(values) - angle_slack, std::max(values) + angle_slack};
}

std::optional<Interval> clipped(const Interval& interval, double most) {
    const Interval inside{std::max(interval.lo, -most), std::min(interval.hi, most)};
    return inside.lo <= inside.hi ? std::optional(inside) : std::nullopt;
}

struct Angles {
    Interval theta, phi;  // phi from -pi to pi, or all of it
};

constexpr double pi = std::numbers::pi;

// Of the directions (u, v, 1) along axes u, v and w, that is w itself.
Angles angles_along_2(const Slopes& slopes) {
    const auto& [u, v] = slopes;
    const auto nearest = [](const Interval& i) { return std::clamp(0.0, i.lo, i.hi); };
    const auto farthest = [](const Interval& i) { return std::max(std::abs(i.lo), std::abs(i.hi)); };
    Angles angles;
    angles.theta = {std::atan(std::hypot(nearest(u), nearest(v))),
                    std::atan(std::hypot(farthest(u), farthest(v)))};
    if (u.lo <= 0 && 0 <= u.hi && v.lo <= 0 && 0 <= v.hi) {
        angles.phi = {-pi, pi};
        return angles;
    }
    // As seen from a point outside a rectangle is within the angle of two of its corners.
    const double middle = std::atan2((v.lo + v.hi) / 2, (u.lo + u.hi) / 2);
    angles.phi = {middle, middle};
    for (const double cu : {u.lo, u.hi}) {
        for (const double cv : {v.lo, v.hi}) {
            const double from_middle = std::remainder(std::atan2(cv, cu) - middle, 2 * pi);
            angles.phi.lo = std::min(angles.phi.lo, middle + from_middle);
            angles.phi.hi = std::max(angles.phi.hi, middle + from_middle);
        }
    }
    return angles;
}

// Of directions whose part across axis 2 is (1, across) or turned by a quarter, and along it `up`.
Angles angles_across_2(const Interval& across, const Interval& up, double turn) {
    const double nearest = std::hypot(1, std::clamp(0.0, across.lo, across.hi));
    const double farthest = std::hypot(1, std::max(std::abs(across.lo), std::abs(across.hi)));
    Angles angles;
    angles.phi = {turn + std::atan(across.lo), turn + std::atan(across.hi)};
    // The higher `up`, the smaller theta; the nearer, the farther from a quarter.
    angles.theta = {std::atan2(up.hi > 0 ? nearest : farthest, up.hi),
                    std::atan2(up.lo > 0 ? farthest : nearest, up.lo)};
    return angles;
}

}  // namespace

DirectionGrid::DirectionGrid(int side) : side_(side) {
    base::check(side >= 4 && side % 4 == 0, "a direction grid's axes lie on its cells' edges");
}

std::optional<Slopes> DirectionGrid::slopes(int cell, int axis) const {
    const int i = cell / (side_ / 2);
    const int j = cell % (side_ / 2);
    const std::array<double, 2> theta{pi * i / side_, pi * (i + 1) / side_};
    const std::array<double, 2> phi{2 * pi * j / side_, 2 * pi * (j + 1) / side_};
    // Within a cell each ratio of two parts is monotonous in either angle, so corners tell. Where the axis'
    // part is 0 the lines are clipped away, but for what is near.
    constexpr double steep = 1e12;
    std::array<double, 4> u{}, v{};
    std::size_t n = 0;
    for (const double t : theta) {
        for (const double p : phi) {
            const std::array<double, 3> d{std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
            const auto along = [&](int a) { return d[static_cast<std::size_t>(a % 3)]; };
            const double inside = std::sin((theta[0] + theta[1]) / 2);
            const std::array<double, 3> middle{inside * std::cos((phi[0] + phi[1]) / 2),
                                               inside * std::sin((phi[0] + phi[1]) / 2),
                                               std::cos((theta[0] + theta[1]) / 2)};
            const double sign = middle[static_cast<std::size_t>(axis)] < 0 ? -1 : 1;
            const double w = std::max(along(axis) * sign, 1 / steep) * sign;
            u[n] = along(axis + 1) / w;
            v[n++] = along(axis + 2) / w;
        }
    }
    const auto u_slopes = clipped(hull({u[0], u[1], u[2], u[3]}), steepest);
    const auto v_slopes = clipped(hull({v[0], v[1], v[2], v[3]}), steepest);
    if (!u_slopes || !v_slopes) {
        return std::nullopt;
    }
    return Slopes{*u_slopes, *v_slopes};
}

void DirectionGrid::cells_of(int axis, const Slopes& slopes, std::vector<int>& out) const {
    Angles angles;
    if (axis == 2) {
        angles = angles_along_2(slopes);  // u and v are axes 0 and 1
    } else if (axis == 0) {
        angles = angles_across_2(slopes.u, slopes.v, 0);  // axes 1 and 2
    } else {
        // u and v are axes 2 and 0: phi is that of (v, 1).
        angles = angles_across_2({-slopes.v.hi, -slopes.v.lo}, slopes.u, pi / 2);
    }
    const auto cell_at = [&](double angle, double whole) {
        return static_cast<int>(std::floor(angle / whole * side_));
    };
    const int i0 = std::max(cell_at(angles.theta.lo - angle_slack, pi), 0);
    const int i1 = std::min(cell_at(angles.theta.hi + angle_slack, pi), side_ - 1);
    const int j0 = cell_at(angles.phi.lo - angle_slack, 2 * pi);
    const int j1 = std::min(cell_at(angles.phi.hi + angle_slack, 2 * pi), j0 + side_ - 1);
    out.clear();
    for (int i = i0; i <= i1; ++i) {
        for (int j = j0; j <= j1; ++j) {
            const int around = ((j % side_) + side_) % side_;
            const bool there = around < side_ / 2;
            out.push_back(there ? i * (side_ / 2) + around
                                : (side_ - 1 - i) * (side_ / 2) + around - side_ / 2);
        }
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
}

}  // namespace shearwater::culling
