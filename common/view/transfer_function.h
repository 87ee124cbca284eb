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
// A trapezium: `height` over the width `top` about `centre` + `lean`, falling to 0 at the width `base` about
// `centre`. The top lies within the base.
struct Hat {
    double centre = 0.5, top = 0, base = 0.1, height = 1, lean = 0;
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
    // Positions and widths may reach beyond [0, 1], so that a pin can be moved partly out of sight.
    static constexpr double farthest = 1e6;
    static constexpr double min_density = 1e-3, max_density = 1e3;

    std::vector<OpacityPin> opacity_pins;
    std::vector<ColourPin> colour_pins;  // by rising position; at least one
    Rgb background;                      // behind everything, black unless set
    // Multiplies the extinction that the pins stand for: as if a unit of length were so much longer.
    double density = 1;

    bool operator==(const TransferFunction&) const = default;

    // The largest of the pins, 0 inside a blank. In [0, 1].
    double height(double s) const;
    // Opacity of one world unit of length: 1 - (1 - height)^density.
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
// The name of the map that these pins are, or empty.
std::string colour_map_name(const std::vector<ColourPin>& pins);

// inferno over a ramp from (0.2, 0) to (1, 0.5).
TransferFunction default_transfer_function();

// Every number finite and in range, at most max_pins of each kind, pins in order.
base::Status validate(const TransferFunction& tf);

}  // namespace shearwater::view
