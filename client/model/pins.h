#pragma once
// What a person does to the pins of a transfer function (DVR 4.3): adds them, moves them by their handles,
// turns one kind into another. Positions are in s.

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/view/transfer_function.h"

namespace shearwater::model {

// The kinds of pins, and of hats those with names of their own.
enum class Shape { ramp, hat, top_hat, triangle, flat, blank };
inline constexpr std::array shapes{Shape::ramp,     Shape::hat,  Shape::top_hat,
                                   Shape::triangle, Shape::flat, Shape::blank};
std::string_view name(Shape shape);  // "top-hat"
Shape shape_of(const view::OpacityPin& pin);

// A pin about (s, height) within [0, 1]; `height` means nothing to a blank.
view::OpacityPin new_pin(Shape shape, double s, double height);
// Another shape over the same values and of the same height, as far as it has one.
view::OpacityPin retyped(const view::OpacityPin& pin, Shape shape);

// A place on a pin by which it is dragged.
struct Handle {
    std::string_view name;
    double s;
    std::optional<double> height;  // none: the handle is an edge, and moves along s only
};
// A ramp's "low" and "high" ends; a hat's "top", "top-low", "top-high", "base-low", "base-high"; a flat's
// "height", in the middle; a blank's "lo" and "hi".
std::vector<Handle> handles_of(const view::OpacityPin& pin);
// The pin with that handle as near to (s, height) as may be. A hat keeps its middle while its edges move.
view::OpacityPin dragged(const view::OpacityPin& pin, std::size_t handle, double s, double height);
// The whole pin, moved along s.
view::OpacityPin shifted(const view::OpacityPin& pin, double by);

// The positions at which a pin bends or ends: 2 of a ramp or a blank, 4 of a hat, none of a flat.
std::vector<double> edges_of(const view::OpacityPin& pin);
// The pin's height at a place; 0 for a blank.
double height_at(const view::OpacityPin& pin, double s);

// ---- numbers, as they are typed ----

struct Field {
    std::string_view name;
    bool is_height;  // else a position
};
// A ramp's "x0" "a0" "x1" "a1"; a hat's "from" "top from" "top to" "to" "height", which are its feet and
// shoulders; a flat's "height"; a blank's "lo" "hi".
std::vector<Field> fields_of(const view::OpacityPin& pin);
double field(const view::OpacityPin& pin, std::size_t number);
// With the number in the field, brought into range; others give way where they must. What is not finite
// changes nothing.
view::OpacityPin with_field(const view::OpacityPin& pin, std::size_t number, double value);

constexpr double least_width = 1.0 / 4096;  // of a ramp

}  // namespace shearwater::model
