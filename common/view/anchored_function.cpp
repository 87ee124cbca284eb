#include "common/view/anchored_function.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace shearwater::view {

namespace {

// From one scale to another: a function that nowhere falls.
using Convert = std::function<double(double)>;

constexpr double least_width = 1e-9;  // of a step

Ramp converted(Ramp ramp, const Convert& to) {
    const bool rises = ramp.x0 < ramp.x1;
    ramp.x0 = to(ramp.x0);
    ramp.x1 = to(ramp.x1);
    if (rises && !(ramp.x0 + least_width < ramp.x1)) {
        ramp.x1 = ramp.x0 + least_width * std::max(1.0, std::abs(ramp.x0));
    }
    return ramp;
}

Hat converted(const Hat& hat, const Convert& to) {
    if (!(hat.top >= 0 && hat.base >= hat.top)) {
        return hat;  // and refused as it is
    }
    const double middle = hat.centre + hat.lean;
    const double foot_low = to(hat.centre - hat.base / 2), foot_high = to(hat.centre + hat.base / 2);
    const double low = std::clamp(to(middle - hat.top / 2), foot_low, foot_high);
    const double high = std::clamp(to(middle + hat.top / 2), low, foot_high);
    Hat result{.centre = (foot_low + foot_high) / 2,
               .top = high - low,
               .base = foot_high - foot_low,
               .height = hat.height};
    const double room = (result.base - result.top) / 2;
    const double lean = std::clamp((low + high) / 2 - result.centre, -room, room);
    result.lean = std::abs(lean) < 1e-12 * result.base ? 0 : lean;  // an upright one stays so
    return result;
}

Flat converted(const Flat& flat, const Convert&) {
    return flat;
}

Blank converted(const Blank& blank, const Convert& to) {
    return {to(blank.lo), to(blank.hi)};
}

TransferFunction converted(TransferFunction tf, bool colours, const Convert& to) {
    for (OpacityPin& pin : tf.opacity_pins) {
        pin = std::visit([&](const auto& kind) { return OpacityPin(converted(kind, to)); }, pin);
    }
    for (ColourPin& pin : tf.colour_pins) {
        pin.at = colours ? to(pin.at) : pin.at;
    }
    return tf;
}

}  // namespace

base::Result<TransferFunction> on_scale(const AnchoredFunction& function, const ValueScale* scale) {
    if (function.unit == Unit::stretched) {
        return function.tf;
    }
    const std::string fault = scale == nullptr ? "the cube is not known" : scale->fault_of(function.unit);
    if (!fault.empty()) {
        return base::error(base::Code::unsupported,
                           "use a transfer function by " + std::string(name(function.unit)), fault);
    }
    TransferFunction tf =
        converted(function.tf, function.own_colours, [&](double x) { return scale->to_s(function.unit, x); });
    if (const auto status = validate(tf); !status) {
        return status.error();
    }
    return tf;
}

AnchoredFunction anchored(const TransferFunction& tf, Unit unit, const ValueScale& scale) {
    const bool own = colour_map_name(tf.colour_pins).empty();
    if (unit == Unit::stretched) {
        return {tf, unit, own};
    }
    return {converted(tf, own, [&](double s) { return scale.from_s(unit, s); }), unit, own};
}

}  // namespace shearwater::view
