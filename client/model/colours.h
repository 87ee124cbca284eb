#pragma once
// What a person does to the colours of a transfer function: pins of their own, and maps by name.

#include <optional>
#include <string>
#include <string_view>

#include "common/view/transfer_function.h"

namespace shearwater::model {

// A pin at a place in [0, 1], of the colour that is there. Its index, or nothing where there are too many.
std::optional<std::size_t> add_colour(view::TransferFunction& tf, double at);
// As far as its neighbours.
void move_colour(view::TransferFunction& tf, std::size_t pin, double at);
void set_colour(view::TransferFunction& tf, std::size_t pin, const view::Rgb& rgb);
// The last one stays.
void remove_colour(view::TransferFunction& tf, std::size_t pin);

// In the place of all pins. An unknown name changes nothing.
void choose_map(view::TransferFunction& tf, std::string_view name);
// The map so many places on in the menu, in the same direction; the first or the last instead of own pins.
void step_map(view::TransferFunction& tf, int step);
// Low for high, own pins too.
void reverse_colours(view::TransferFunction& tf);

}  // namespace shearwater::model
