#pragma once
// From stretched values s in [0, 1] to opacity and colour: the pins of DVR 4.3.

#include <array>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/base/result.h"

namespace shearwater::view {

// Linear from (x0, a0) to (x1, a1), constant outside. x0 < x1.
struct Ramp {
    double x0 = 0, a0 = 0, x1 = 1, a1 = 1;
    bool operator==(const Ramp&) const = default;
};
// A trapezium: `height` over the width `top` about `centre`, falling to 0 at the width `base`.
struct Hat {
    double centre = 0.5, top = 0, base = 0.1, height = 1;
    bool operator==(const Hat&) const = default;
};
struct Flat {
    double height = 0;
    bool operator==(const Flat&) const = default;
};
// Transparent in [lo, hi], whatever the other pins say.
struct Blank {
    double lo = 0, hi = 0;
    bool operator==(const Blank&) const = default;
};
using OpacityPin = std::variant<Ramp, Hat, Flat, Blank>;

struct Rgb {
    double r = 0, g = 0, b = 0;  // 0 to 1
    bool operator==(const Rgb&) const = default;
};
struct ColourPin {
    double at = 0;
    Rgb rgb;
    bool operator==(const ColourPin&) const = default;
};

struct TransferFunction {
    static constexpr std::size_t max_pins = 256;

    std::vector<OpacityPin> opacity_pins;
    std::vector<ColourPin> colour_pins;  // by rising position; at least one
    Rgb background;                      // behind everything, black unless set

    bool operator==(const TransferFunction&) const = default;

    // Opacity of one world unit of length: the largest of the pins, 0 inside a blank. In [0, 1].
    double opacity(double s) const;
    // Optical depth per world unit: -ln(1 - opacity), at most `opaque`.
    double extinction(double s) const;
    static constexpr double opaque = 1e3;
    // Linear between pins, the end pins' colours outside.
    Rgb colour(double s) const;
};

// The maps that astronomers expect; their names in the order of a menu, "-r" behind one reverses it.
std::vector<std::string> colour_map_names();
base::Result<std::vector<ColourPin>> colour_map(std::string_view name);

// inferno over a ramp from (0.2, 0) to (1, 0.5).
TransferFunction default_transfer_function();

// Every number finite and in range, at most max_pins of each kind, pins in order.
base::Status validate(const TransferFunction& tf);

// The TOML form of design section 3. An unknown key or kind is refused by name.
base::Result<TransferFunction> transfer_function_from_toml(std::string_view text, std::string_view source);
// `within`: the table of a larger document that the text stands in, whose heading is written before it.
std::string to_toml(const TransferFunction& tf, const std::string& within = {});

}  // namespace shearwater::view
