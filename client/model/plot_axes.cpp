#include "client/model/plot_axes.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "client/model/pins.h"
#include "client/model/world_steps.h"

namespace shearwater::model {

namespace {

const double decades = -std::log10(least_logarithmic);

std::vector<double> round_positions(double lo, double hi, int wanted) {
    const double step = round_step((hi - lo) / wanted);
    std::vector<double> positions;
    if (!(step > 0) || !std::isfinite(step)) {
        return positions;
    }
    const double first = std::ceil(lo / step - 1e-9);
    for (int i = 0; i <= 3 * wanted && (first + i) * step <= hi + step * 1e-9; ++i) {
        positions.push_back((first + i) * step);
    }
    return positions;
}

}  // namespace

std::string_view name(OpacityAxis axis) {
    constexpr std::array<std::string_view, 3> names{"cube root", "log", "linear"};
    return names.at(static_cast<std::size_t>(axis));
}

double height_share(OpacityAxis axis, double opacity) {
    const double a = std::clamp(opacity, 0.0, 1.0);
    switch (axis) {
        case OpacityAxis::cube_root:
            return std::cbrt(a);
        case OpacityAxis::logarithmic:
            return a > least_logarithmic ? 1 + std::log10(a) / decades : 0;
        case OpacityAxis::linear:
            break;
    }
    return a;
}

double opacity_at(OpacityAxis axis, double share) {
    const double up = std::clamp(share, 0.0, 1.0);
    switch (axis) {
        case OpacityAxis::cube_root:
            return up * up * up;
        case OpacityAxis::logarithmic:
            return up > 0 ? std::pow(10.0, (up - 1) * decades) : 0;
        case OpacityAxis::linear:
            break;
    }
    return up;
}

std::vector<double> opacity_marks(OpacityAxis axis) {
    switch (axis) {
        case OpacityAxis::cube_root:
            return {0.01, 0.1, 0.5};
        case OpacityAxis::logarithmic:
            return {1e-4, 1e-3, 0.01, 0.1};
        case OpacityAxis::linear:
            break;
    }
    return {0.25, 0.5, 0.75};
}

std::vector<Tick> ticks(const view::ValueScale& scale, view::Unit unit, int wanted) {
    const double lo = scale.from_s(unit, 0), hi = scale.from_s(unit, 1);
    std::vector<double> positions;
    if (unit == view::Unit::percentile) {
        positions = {0.01, 0.1, 1, 5, 10, 25, 50, 75, 90, 95, 99, 99.5, 99.9, 99.99, 99.999};
    } else {
        positions = round_positions(lo, hi, std::max(wanted, 1));
    }
    std::vector<Tick> marks;
    for (const double position : positions) {
        const double s = scale.to_s(unit, position);
        if (s >= -1e-9 && s <= 1 + 1e-9 && (marks.empty() || s > marks.back().s)) {
            marks.push_back({std::clamp(s, 0.0, 1.0), position_text(position)});
        }
    }
    return marks;
}

std::string position_text(double position) {
    return fmt::format("{:.4g}", position == 0 ? 0.0 : position);
}

std::string unit_text(view::Unit unit, const std::string& data_unit) {
    switch (unit) {
        case view::Unit::value:
            return data_unit;
        case view::Unit::percentile:
            return "%";
        case view::Unit::sigma:
            return "\u03c3";
        case view::Unit::stretched:
            break;
    }
    return {};
}

std::vector<double> snap_targets(const view::TransferFunction& tf, std::size_t but,
                                 std::span<const Tick> ticks) {
    std::vector<double> targets;
    for (std::size_t i = 0; i < tf.opacity_pins.size(); ++i) {
        if (i != but) {
            const std::vector<double> edges = edges_of(tf.opacity_pins[i]);
            targets.insert(targets.end(), edges.begin(), edges.end());
        }
    }
    for (const Tick& tick : ticks) {
        targets.push_back(tick.s);
    }
    return targets;
}

double snapped(double s, std::span<const double> targets, double reach) {
    double nearest = s;
    for (const double target : targets) {
        if (std::abs(target - s) <= reach) {
            reach = std::abs(target - s);
            nearest = target;
        }
    }
    return nearest;
}

}  // namespace shearwater::model
