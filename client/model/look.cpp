#include "client/model/look.h"

#include <algorithm>
#include <cmath>

namespace shearwater::model {

std::string map_name_of(const std::vector<view::ColourPin>& pins) {
    for (const std::string& name : view::colour_map_names()) {
        for (const std::string& variant : {name, name + "-r"}) {
            if (view::colour_map(variant).value() == pins) {
                return variant;
            }
        }
    }
    return {};
}

const view::Ramp* ramp_of(const view::TransferFunction& tf) {
    for (const view::OpacityPin& pin : tf.opacity_pins) {
        if (const auto* ramp = std::get_if<view::Ramp>(&pin)) {
            return ramp;
        }
    }
    return nullptr;
}

void set_ramp(view::TransferFunction& tf, view::Ramp ramp) {
    if (!std::isfinite(ramp.x0 + ramp.a0 + ramp.x1 + ramp.a1)) {
        return;
    }
    ramp.x0 = std::clamp(ramp.x0, 0.0, 1.0 - min_ramp_width);
    ramp.x1 = std::clamp(ramp.x1, ramp.x0 + min_ramp_width, 1.0);
    ramp.a0 = std::clamp(ramp.a0, 0.0, 1.0);
    ramp.a1 = std::clamp(ramp.a1, 0.0, 1.0);
    for (view::OpacityPin& pin : tf.opacity_pins) {
        if (std::holds_alternative<view::Ramp>(pin)) {
            pin = ramp;
            return;
        }
    }
    if (tf.opacity_pins.size() < view::TransferFunction::max_pins) {
        tf.opacity_pins.emplace_back(ramp);
    }
}

}  // namespace shearwater::model
