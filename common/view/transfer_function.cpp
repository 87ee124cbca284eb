#include "common/view/transfer_function.h"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

namespace shearwater::view {

namespace {

double opacity_of(const Ramp& ramp, double s) {
    const double t = std::clamp((s - ramp.x0) / (ramp.x1 - ramp.x0), 0.0, 1.0);
    return ramp.a0 + t * (ramp.a1 - ramp.a0);
}

// Either side as if it were the right one.
double opacity_of(const Hat& hat, double s) {
    const double from_centre = s - hat.centre;
    const double side = from_centre < hat.lean ? -1 : 1;
    const double foot = hat.base / 2, shoulder = side * hat.lean + hat.top / 2;
    if (side * (from_centre - hat.lean) <= hat.top / 2) {
        return hat.height;
    }
    if (side * from_centre >= foot) {
        return 0;
    }
    return hat.height * (foot - side * from_centre) / (foot - shoulder);
}

double opacity_of(const Flat& flat, double) {
    return flat.height;
}
double opacity_of(const Blank&, double) {
    return 0;
}

bool blanks(const OpacityPin& pin, double s) {
    const Blank* blank = std::get_if<Blank>(&pin);
    return blank != nullptr && blank->lo <= s && s <= blank->hi;
}

bool is_position(double x) {
    return std::isfinite(x) && std::abs(x) <= TransferFunction::farthest;
}
bool is_share(double a) {
    return a >= 0 && a <= 1;
}

// What is wrong with a pin, or nothing.
std::string_view fault_of(const Ramp& ramp) {
    if (!is_position(ramp.x0) || !is_position(ramp.x1) || !(ramp.x0 < ramp.x1)) {
        return "ramp: x0 must lie below x1";
    }
    return is_share(ramp.a0) && is_share(ramp.a1) ? "" : "ramp: a0 and a1 must lie in 0 to 1";
}

std::string_view fault_of(const Hat& hat) {
    if (!is_position(hat.centre) || !is_position(hat.top) || !is_position(hat.base)) {
        return "hat: centre, top and base must be finite";
    }
    if (hat.top < 0 || hat.base < hat.top) {
        return "hat: top must be 0 or more, and base no smaller than top";
    }
    if (!(std::abs(hat.lean) <= (hat.base - hat.top) / 2)) {
        return "hat: lean must not carry the top beyond the base";
    }
    return is_share(hat.height) ? "" : "hat: height must lie in 0 to 1";
}

std::string_view fault_of(const Flat& flat) {
    return is_share(flat.height) ? "" : "flat: height must lie in 0 to 1";
}

std::string_view fault_of(const Blank& blank) {
    return is_position(blank.lo) && is_position(blank.hi) && blank.lo <= blank.hi
               ? ""
               : "blank: lo must not lie above hi";
}

bool is_colour(const Rgb& rgb) {
    return is_share(rgb.r) && is_share(rgb.g) && is_share(rgb.b);
}

std::string fault_of_colours(const std::vector<ColourPin>& pins) {
    for (std::size_t i = 0; i < pins.size(); ++i) {
        if (!is_position(pins[i].at)) {
            return fmt::format("colour pin {}: its position must be finite", i + 1);
        }
        if (!is_colour(pins[i].rgb)) {
            return fmt::format("colour pin {}: red, green and blue must lie in range", i + 1);
        }
        if (i > 0 && !(pins[i - 1].at <= pins[i].at)) {
            return fmt::format("colour pin {}: positions must rise", i + 1);
        }
    }
    return {};
}

std::string fault_of(const TransferFunction& tf) {
    if (tf.opacity_pins.size() > TransferFunction::max_pins ||
        tf.colour_pins.size() > TransferFunction::max_pins) {
        return fmt::format("more than {} pins", TransferFunction::max_pins);
    }
    if (tf.colour_pins.empty()) {
        return "no colour pin";
    }
    for (std::size_t i = 0; i < tf.opacity_pins.size(); ++i) {
        const auto fault = std::visit([](const auto& pin) { return fault_of(pin); }, tf.opacity_pins[i]);
        if (!fault.empty()) {
            return fmt::format("opacity pin {}: {}", i + 1, fault);
        }
    }
    if (!(tf.density >= TransferFunction::min_density && tf.density <= TransferFunction::max_density)) {
        return fmt::format("density: it must lie in {} to {}", TransferFunction::min_density,
                           TransferFunction::max_density);
    }
    return is_colour(tf.background) ? fault_of_colours(tf.colour_pins) : "background: out of range";
}

}  // namespace

double TransferFunction::height(double s) const {
    double largest = 0;
    for (const OpacityPin& pin : opacity_pins) {
        if (blanks(pin, s)) {
            return 0;
        }
        largest = std::max(largest, std::visit([s](const auto& p) { return opacity_of(p, s); }, pin));
    }
    return largest;
}

double TransferFunction::opacity(double s) const {
    const double a = height(s);
    return density == 1 ? a : -std::expm1(density * std::log1p(-a));
}

double TransferFunction::extinction(double s) const {
    const double a = height(s);
    return a < 1 ? std::min(-density * std::log1p(-a), opaque) : opaque;
}

Rgb TransferFunction::colour(double s) const {
    const auto above = std::upper_bound(colour_pins.begin(), colour_pins.end(), s,
                                        [](double value, const ColourPin& pin) { return value < pin.at; });
    if (above == colour_pins.begin()) {
        return colour_pins.empty() ? Rgb{} : colour_pins.front().rgb;
    }
    const ColourPin& a = *(above - 1);
    if (above == colour_pins.end()) {
        return a.rgb;
    }
    const double t = (s - a.at) / (above->at - a.at);
    const auto mix = [t](double from, double to) { return from + t * (to - from); };
    return {mix(a.rgb.r, above->rgb.r), mix(a.rgb.g, above->rgb.g), mix(a.rgb.b, above->rgb.b)};
}

TransferFunction default_transfer_function() {
    return {.opacity_pins = {Ramp{.x0 = 0.2, .a0 = 0, .x1 = 1, .a1 = 0.5}},
            .colour_pins = colour_map("inferno").value(),
            .background = {}};
}

base::Status validate(const TransferFunction& tf) {
    if (std::string fault = fault_of(tf); !fault.empty()) {
        return base::error(base::Code::invalid_argument, "use the transfer function", std::move(fault));
    }
    return {};
}

}  // namespace shearwater::view
