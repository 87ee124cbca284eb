#pragma once
// From physical values to the codes that bricks hold (design: "Value").

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace shearwater::volume {

enum class Stretch { linear, sqrt, log, asinh };

// By number.
constexpr std::array<std::string_view, 4> stretch_names{"linear", "sqrt", "log", "asinh"};
std::string_view name(Stretch stretch);
std::optional<Stretch> stretch_named(std::string_view name);

// stretch(t) for t in [0, 1]: linear t; sqrt; log10(1 + 999 t) / 3; asinh(10 t) / asinh(10).
double apply(Stretch stretch, double t);
// The t in [0, 1] with apply(stretch, t) == s.
double invert(Stretch stretch, double s);

// Where the values that are told apart begin and end, and how they are spread between.
struct Scaling {
    double lo = 0;
    double hi = 1;
    Stretch stretch = Stretch::linear;

    bool operator==(const Scaling&) const = default;
    // lo <= hi, both finite, and their distance too.
    bool valid() const;
};

// t = clamp((v - lo) / (hi - lo), 0, 1), s = stretch(t), code = 1 + round(s * (levels - 1)).
// Code 0 is blank. lo < hi, both finite; lo == hi stands for a constant cube: s is 0 at or below it
// and 1 above.
struct Mapping {
    static Mapping of(const Scaling& scaling, int bits) {
        return {.lo = scaling.lo, .hi = scaling.hi, .stretch = scaling.stretch, .bits = bits};
    }

    double lo = 0;
    double hi = 1;
    Stretch stretch = Stretch::linear;
    int bits = 8;  // 8 or 16

    bool operator==(const Mapping&) const = default;

    Scaling scaling() const { return {lo, hi, stretch}; }
    // The number of codes that stand for a value: 255 or 65535.
    int levels() const { return (1 << bits) - 1; }

    // s in [0, 1] of a finite value.
    double stretched(double value) const;
    // The code of a value: 0 for NaN and infinities.
    std::uint16_t code(double value) const;
    // s of a (possibly interpolated) code >= 1.
    double s_of_code(double code) const { return (code - 1) / (levels() - 1); }
    // The physical value whose s is given.
    double value_of_s(double s) const;
};

}  // namespace shearwater::volume
