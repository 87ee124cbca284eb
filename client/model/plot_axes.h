#pragma once
// The axes of the transfer function's plot: opacity upwards, values to the right.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/view/transfer_function.h"
#include "common/view/value_scale.h"

namespace shearwater::model {

enum class OpacityAxis { cube_root, logarithmic, linear };
std::string_view name(OpacityAxis axis);
// The share of the plot's height at which an opacity lies, and the way back. What is least on the logarithmic
// axis, and below, lies at the bottom, and the bottom is 0.
double height_share(OpacityAxis axis, double opacity);
double opacity_at(OpacityAxis axis, double share);
constexpr double least_logarithmic = 1e-5;
// Opacities to mark.
std::vector<double> opacity_marks(OpacityAxis axis);

struct Tick {
    double s;
    std::string label;
};
// Round positions in a unit that the scale has, for s in [0, 1], rising: some `wanted` of them, or the
// percentiles that people speak of.
std::vector<Tick> ticks(const view::ValueScale& scale, view::Unit unit, int wanted);

// A position as text, without its unit: four figures.
std::string position_text(double position);
// What stands behind it: "mJy/beam", "%", "\u03c3", or nothing.
std::string unit_text(view::Unit unit, const std::string& data_unit);

// What a position snaps to: the edges of all pins but one, and the ticks.
std::vector<double> snap_targets(const view::TransferFunction& tf, std::size_t but,
                                 std::span<const Tick> ticks);
// The nearest of the targets, if one is within reach.
double snapped(double s, std::span<const double> targets, double reach);

}  // namespace shearwater::model
