#include "common/flight/blend.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <type_traits>

namespace shearwater::flight {

namespace {

double mix(double a, double b, double share) {
    return a + share * (b - a);
}

view::Rgb mix(const view::Rgb& a, const view::Rgb& b, double share) {
    return {mix(a.r, b.r, share), mix(a.g, b.g, share), mix(a.b, b.b, share)};
}

view::Ramp mix(const view::Ramp& a, const view::Ramp& b, double share) {
    return {mix(a.x0, b.x0, share), mix(a.a0, b.a0, share), mix(a.x1, b.x1, share), mix(a.a1, b.a1, share)};
}

view::Hat mix(const view::Hat& a, const view::Hat& b, double share) {
    return {mix(a.centre, b.centre, share), mix(a.top, b.top, share), mix(a.base, b.base, share),
            mix(a.height, b.height, share), mix(a.lean, b.lean, share)};
}

view::Flat mix(const view::Flat& a, const view::Flat& b, double share) {
    return {mix(a.height, b.height, share)};
}

view::Blank mix(const view::Blank& a, const view::Blank& b, double share) {
    return {mix(a.lo, b.lo, share), mix(a.hi, b.hi, share)};
}

// Both are linear between the positions of either's pins, and so is what is between them. Two pins of one
// function at one place are a jump, which stays one.
std::vector<view::ColourPin> mix(const view::TransferFunction& a, const view::TransferFunction& b,
                                 double share) {
    const auto& pins_a = a.colour_pins;
    const auto& pins_b = b.colour_pins;
    const bool in_step = std::ranges::equal(pins_a, pins_b, {}, &view::ColourPin::at, &view::ColourPin::at);
    std::vector<view::ColourPin> pins;
    if (in_step) {
        for (std::size_t i = 0; i < pins_a.size(); ++i) {
            pins.push_back({pins_a[i].at, mix(pins_a[i].rgb, pins_b[i].rgb, share)});
        }
        return pins;
    }
    std::vector<double> places;
    for (const auto* some : {&pins_a, &pins_b}) {
        std::ranges::transform(*some, std::back_inserter(places), &view::ColourPin::at);
    }
    std::ranges::sort(places);
    places.erase(std::ranges::unique(places).begin(), places.end());
    for (const double at : places) {
        pins.push_back({at, mix(a.colour(at), b.colour(at), share)});
    }
    if (pins.size() > view::TransferFunction::max_pins) {
        return share < 0.5 ? pins_a : pins_b;
    }
    return pins;
}

bool same_kinds(const view::TransferFunction& a, const view::TransferFunction& b) {
    return std::ranges::equal(
        a.opacity_pins, b.opacity_pins,
        [](const view::OpacityPin& p, const view::OpacityPin& q) { return p.index() == q.index(); });
}

// A pin so much lower; nothing of a blank.
std::optional<view::OpacityPin> lowered(view::OpacityPin pin, double share) {
    if (std::holds_alternative<view::Blank>(pin)) {
        return std::nullopt;
    }
    if (auto* ramp = std::get_if<view::Ramp>(&pin)) {
        ramp->a0 *= share;
        ramp->a1 *= share;
    } else if (auto* hat = std::get_if<view::Hat>(&pin)) {
        hat->height *= share;
    } else if (auto* flat = std::get_if<view::Flat>(&pin)) {
        flat->height *= share;
    }
    return pin;
}

std::vector<view::OpacityPin> fade(const view::TransferFunction& a, const view::TransferFunction& b,
                                   double share) {
    std::vector<view::OpacityPin> pins;
    const auto add = [&](const view::TransferFunction& tf, double height, bool with_blanks) {
        for (const view::OpacityPin& pin : tf.opacity_pins) {
            if (auto low = lowered(pin, height)) {
                pins.push_back(*low);
            } else if (with_blanks) {
                pins.push_back(pin);
            }
        }
    };
    add(a, 1 - share, share < 0.5);
    add(b, share, share >= 0.5);
    return pins;
}

}  // namespace

view::TransferFunction blend(const view::TransferFunction& a, const view::TransferFunction& b, double share) {
    if (share <= 0 || a == b) {
        return a;
    }
    if (share >= 1) {
        return b;
    }
    view::TransferFunction made{.opacity_pins = {},
                                .colour_pins = mix(a, b, share),
                                .background = mix(a.background, b.background, share),
                                .density = a.density * std::pow(b.density / a.density, share)};
    if (same_kinds(a, b)) {
        for (std::size_t i = 0; i < a.opacity_pins.size(); ++i) {
            made.opacity_pins.push_back(std::visit(
                [&](const auto& pin) -> view::OpacityPin {
                    return mix(pin, std::get<std::decay_t<decltype(pin)>>(b.opacity_pins[i]), share);
                },
                a.opacity_pins[i]));
        }
        return made;
    }
    made.opacity_pins = fade(a, b, share);
    if (made.opacity_pins.size() > view::TransferFunction::max_pins) {
        made.opacity_pins = (share < 0.5 ? a : b).opacity_pins;
    }
    return made;
}

}  // namespace shearwater::flight
