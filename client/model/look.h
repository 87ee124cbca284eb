#pragma once
// What a person changes of a transfer function in the panel: its colour map and one ramp.

#include <string>
#include <string_view>

#include "common/view/transfer_function.h"

namespace shearwater::model {

// The name of the colour map these pins are, "-r" behind it when reversed; empty when they are none.
std::string map_name_of(const std::vector<view::ColourPin>& pins);

// The ramp that is edited: the first among the pins, or null.
const view::Ramp* ramp_of(const view::TransferFunction& tf);

// Puts the ramp, brought into range, in the first one's place, or adds it. What is not finite is ignored.
void set_ramp(view::TransferFunction& tf, view::Ramp ramp);
constexpr double min_ramp_width = 1.0 / 256;

}  // namespace shearwater::model
