#include "common/view/value_scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "common/view/transfer_function.h"

namespace shearwater::view {

namespace {

constexpr std::array<std::pair<Unit, std::string_view>, 4> names = {{
    {Unit::stretched, "stretched"},
    {Unit::value, "value"},
    {Unit::percentile, "percentile"},
    {Unit::sigma, "sigma"},
}};

// Inverting log and asinh grows exponentially: what lies farther out is no place on any cube's scale.
constexpr double farthest_inverted = 32;

double kept(double x, double farthest) {
    return std::isnan(x) ? 0 : std::clamp(x, -farthest, farthest);
}

}  // namespace

std::string_view name(Unit unit) {
    return names.at(static_cast<std::size_t>(unit)).second;
}

std::optional<Unit> unit_named(std::string_view name) {
    for (const auto& [unit, text] : names) {
        if (text == name) {
            return unit;
        }
    }
    return std::nullopt;
}

std::string ValueScale::fault_of(Unit unit) const {
    if (unit == Unit::stretched || unit == Unit::value) {
        return {};
    }
    if (summary_ == nullptr) {
        return "the cube's histogram is not known";
    }
    if (summary_->empty()) {
        return "the cube has no value that is not blank";
    }
    if (unit == Unit::sigma && !(summary_->sigma > 0)) {
        return "half of the cube's values are the same, so that they have no robust sigma";
    }
    return {};
}

double ValueScale::value_of(double s) const {
    s = kept(s, TransferFunction::farthest);
    const double width = mapping_.hi > mapping_.lo ? mapping_.hi - mapping_.lo : 1;
    const bool is_line = mapping_.stretch == volume::Stretch::linear;
    const double from_lo = is_line ? s : std::clamp(std::abs(s), 0.0, farthest_inverted);
    const double t = is_line ? s : std::copysign(volume::invert(mapping_.stretch, from_lo), s);
    return kept(mapping_.lo + width * t, std::numeric_limits<double>::max());
}

double ValueScale::s_of(double value) const {
    const double width = mapping_.hi > mapping_.lo ? mapping_.hi - mapping_.lo : 1;
    const double t = (value - mapping_.lo) / width;
    return std::copysign(volume::apply(mapping_.stretch, std::abs(t)), t);
}

double ValueScale::from_s(Unit unit, double s) const {
    switch (unit) {
        case Unit::stretched:
            return s;
        case Unit::value:
            return value_of(s);
        case Unit::percentile:
            return 100 * summary_->share_below(value_of(s));
        case Unit::sigma:
            return (value_of(s) - summary_->median) / summary_->sigma;
    }
    return s;
}

double ValueScale::to_s(Unit unit, double position) const {
    switch (unit) {
        case Unit::stretched:
            break;
        case Unit::value:
            return kept(s_of(position), TransferFunction::farthest);
        case Unit::percentile:
            return kept(s_of(summary_->value_at(position / 100)), TransferFunction::farthest);
        case Unit::sigma:
            return kept(s_of(summary_->median + position * summary_->sigma), TransferFunction::farthest);
    }
    return kept(position, TransferFunction::farthest);
}

}  // namespace shearwater::view
