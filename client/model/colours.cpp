#include "client/model/colours.h"

#include <algorithm>
#include <cmath>

namespace shearwater::model {

namespace {

double share(double x) {
    return std::isfinite(x) ? std::clamp(x, 0.0, 1.0) : 0;
}

}  // namespace

std::optional<std::size_t> add_colour(view::TransferFunction& tf, double at) {
    if (tf.colour_pins.size() >= view::TransferFunction::max_pins || !std::isfinite(at)) {
        return std::nullopt;
    }
    const view::ColourPin pin{share(at), tf.colour(share(at))};
    const auto behind = std::upper_bound(tf.colour_pins.begin(), tf.colour_pins.end(), pin.at,
                                         [](double x, const view::ColourPin& other) { return x < other.at; });
    const auto number = behind - tf.colour_pins.begin();  // before the pins are elsewhere
    tf.colour_pins.insert(behind, pin);
    return static_cast<std::size_t>(number);
}

void move_colour(view::TransferFunction& tf, std::size_t pin, double at) {
    if (pin >= tf.colour_pins.size() || !std::isfinite(at)) {
        return;
    }
    constexpr double far = view::TransferFunction::farthest;
    const double lo = pin > 0 ? tf.colour_pins[pin - 1].at : -far;
    const double hi = pin + 1 < tf.colour_pins.size() ? tf.colour_pins[pin + 1].at : far;
    tf.colour_pins[pin].at = std::clamp(at, lo, hi);
}

void set_colour(view::TransferFunction& tf, std::size_t pin, const view::Rgb& rgb) {
    if (pin < tf.colour_pins.size()) {
        tf.colour_pins[pin].rgb = {share(rgb.r), share(rgb.g), share(rgb.b)};
    }
}

void remove_colour(view::TransferFunction& tf, std::size_t pin) {
    if (pin < tf.colour_pins.size() && tf.colour_pins.size() > 1) {
        tf.colour_pins.erase(tf.colour_pins.begin() + static_cast<std::ptrdiff_t>(pin));
    }
}

void choose_map(view::TransferFunction& tf, std::string_view name) {
    if (auto pins = view::colour_map(name)) {
        tf.colour_pins = *std::move(pins);
    }
}

void step_map(view::TransferFunction& tf, int step) {
    const std::vector<std::string> names = view::colour_map_names();
    const std::string current = view::colour_map_name(tf.colour_pins);
    const bool reversed = current.ends_with("-r");
    const std::string plain = reversed ? current.substr(0, current.size() - 2) : current;
    const auto found = std::find(names.begin(), names.end(), plain);
    const int count = static_cast<int>(names.size());
    const int from = found == names.end() ? (step > 0 ? -step : 0) : static_cast<int>(found - names.begin());
    const std::string& to = names[static_cast<std::size_t>(((from + step) % count + count) % count)];
    choose_map(tf, to + (reversed ? "-r" : ""));
}

void reverse_colours(view::TransferFunction& tf) {
    const std::string name = view::colour_map_name(tf.colour_pins);
    if (!name.empty()) {
        return choose_map(tf, name.ends_with("-r") ? name.substr(0, name.size() - 2) : name + "-r");
    }
    std::reverse(tf.colour_pins.begin(), tf.colour_pins.end());
    for (view::ColourPin& pin : tf.colour_pins) {
        pin.at = 1 - pin.at;
    }
}

}  // namespace shearwater::model
