#include "common/volume/mapping.h"

#include <algorithm>
#include <cmath>

namespace shearwater::volume {

std::string_view name(Stretch stretch) {
    return stretch_names[static_cast<std::size_t>(stretch)];
}

std::optional<Stretch> stretch_named(std::string_view name) {
    const auto found = std::ranges::find(stretch_names, name);
    return found == stretch_names.end() ? std::nullopt
                                        : std::optional(static_cast<Stretch>(found - stretch_names.begin()));
}

double apply(Stretch stretch, double t) {
    switch (stretch) {
        case Stretch::linear:
            return t;
        case Stretch::sqrt:
            return std::sqrt(t);
        case Stretch::log:
            return std::log10(1 + 999 * t) / 3;
        case Stretch::asinh:
            return std::asinh(10 * t) / std::asinh(10.0);
    }
    return t;
}

double invert(Stretch stretch, double s) {
    switch (stretch) {
        case Stretch::linear:
            return s;
        case Stretch::sqrt:
            return s * s;
        case Stretch::log:
            return (std::pow(10.0, 3 * s) - 1) / 999;
        case Stretch::asinh:
            return std::sinh(s * std::asinh(10.0)) / 10;
    }
    return s;
}

bool Scaling::valid() const {
    return std::isfinite(lo) && std::isfinite(hi) && std::isfinite(hi - lo) && lo <= hi;
}

double Mapping::stretched(double value) const {
    if (!(lo < hi)) {
        return value > lo ? 1 : 0;
    }
    const double t = std::clamp((value - lo) / (hi - lo), 0.0, 1.0);
    return std::clamp(apply(stretch, t), 0.0, 1.0);
}

std::uint16_t Mapping::code(double value) const {
    if (!std::isfinite(value)) {
        return 0;
    }
    return static_cast<std::uint16_t>(1 + std::floor(stretched(value) * (levels() - 1) + 0.5));
}

double Mapping::value_of_s(double s) const {
    return lo + (hi - lo) * std::clamp(invert(stretch, s), 0.0, 1.0);
}

}  // namespace shearwater::volume
