#include "common/wcs/text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace shearwater::wcs {

namespace {

constexpr const char* degree = "\u00b0";

// Digits behind the point that a step of this size needs.
int decimals_of(double step, int most) {
    if (!(step > 0) || !std::isfinite(step)) {
        return most;
    }
    return std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, most);
}

struct Signs {
    const char *whole, *minutes, *seconds;
};

// A number of seconds, of which 3600 are a whole, as far as the resolution goes (seconds too).
std::string sexagesimal(double seconds, double resolution, const Signs& signs, double whole_circle) {
    const int decimals = decimals_of(resolution, 6);
    const double unit = resolution >= 3600 * (1 - 1e-9) ? 3600
                        : resolution >= 60 * (1 - 1e-9) ? 60
                                                        : std::pow(10.0, -decimals);
    double count = std::round(seconds / unit);
    if (whole_circle > 0 && count * unit >= whole_circle) {
        count -= std::round(whole_circle / unit);
    }
    const double rounded = count * unit + unit * 1e-3;  // no second is lost to the representation
    const double whole = std::floor(rounded / 3600);
    const double minutes = std::floor((rounded - 3600 * whole) / 60);
    const double left = std::max(0.0, rounded - 3600 * whole - 60 * minutes - unit * 1e-3);
    std::string words = fmt::format("{:02.0f}{}", whole, signs.whole);
    if (unit < 3600) {
        words += fmt::format("{:02.0f}{}", minutes, signs.minutes);
    }
    if (unit < 60) {
        words += fmt::format("{:0{}.{}f}{}", left, decimals > 0 ? decimals + 3 : 2, decimals, signs.seconds);
    }
    return words;
}

std::string plain(double value, double resolution) {
    constexpr double longest = 1e9, finest = 1e-6;
    const double size = std::abs(value);
    if (size >= longest || !(resolution >= finest)) {
        const double digits = size > 0 && resolution > 0 ? std::ceil(std::log10(size / resolution)) + 1 : 6;
        return fmt::format("{:.{}g}", value, static_cast<int>(std::clamp(digits, 1.0, 12.0)));
    }
    std::string words = fmt::format("{:.{}f}", value, decimals_of(resolution, 6));
    const bool zero = words.find_first_not_of("-0.") == std::string::npos;
    return zero && words.starts_with('-') ? words.substr(1) : words;
}

double on_circle(double degrees) {
    return degrees - 360 * std::floor(degrees / 360);
}

// Beside the signs of angles.
bool has_unit(const Axis& axis) {
    return axis.notation == Notation::plain && !axis.unit.empty() && axis.unit != "deg";
}

double resolution_at(const Axis& axis, int along, const volume::Index3& n, const Place& place) {
    Place before = place, after = place;
    before[static_cast<std::size_t>(along)] -= 0.5;
    after[static_cast<std::size_t>(along)] += 0.5;
    constexpr double finer = 5;  // than a voxel
    return std::abs(difference(axis, value_at(axis, n, before), value_at(axis, n, after))) / finer;
}

}  // namespace

std::string number_text(const Axis& axis, double value, double resolution) {
    if (!std::isfinite(value)) {
        return "-";
    }
    switch (axis.notation) {
        case Notation::hours: {
            constexpr double seconds = 240;  // of time, a degree
            return sexagesimal(on_circle(value) * seconds, resolution * seconds, {"h", "m", "s"}, 86400);
        }
        case Notation::degrees: {
            const std::string words =
                sexagesimal(std::abs(value) * 3600, resolution * 3600, {degree, "'", "\""}, 0);
            const bool zero = words.find_first_of("123456789") == std::string::npos;
            return (value < 0 && !zero ? "-" : "+") + words;
        }
        case Notation::plain:
            break;
    }
    std::string words = plain(axis.circle ? on_circle(value) : value, resolution);
    if (axis.circle && words == plain(360, resolution)) {
        words = plain(0, resolution);
    }
    return axis.unit == "deg" ? words + degree : words;
}

std::string value_text(const Axis& axis, double value, double resolution) {
    return number_text(axis, value, resolution) + (has_unit(axis) ? " " + axis.unit : "");
}

std::string title_text(const Axis& axis) {
    return has_unit(axis) ? axis.name + " (" + axis.unit + ")" : axis.name;
}

std::string short_title_text(const Axis& axis) {
    return has_unit(axis) ? axis.label + " (" + axis.unit + ")" : axis.label;
}

std::string place_text(const Axes& axes, const volume::Index3& n, const Place& place) {
    std::string words;
    for (int along = 0; along < 3; ++along) {
        const Axis& axis = axes[static_cast<std::size_t>(along)];
        if (axis.known()) {
            words += (words.empty() ? "" : "  ") + axis.label + " " +
                     value_text(axis, value_at(axis, n, place), resolution_at(axis, along, n, place));
        }
    }
    return words;
}

std::string plane_text(const Axes& axes, int along, const volume::Index3& n, double plane) {
    const Axis& axis = axes[static_cast<std::size_t>(along)];
    if (!axis.known()) {
        return {};
    }
    Place place;
    for (std::size_t a = 0; a < 3; ++a) {
        place[a] = static_cast<double>(n[a] - 1) / 2;
    }
    place[static_cast<std::size_t>(along)] = plane;
    return value_text(axis, value_at(axis, n, place), resolution_at(axis, along, n, place));
}

}  // namespace shearwater::wcs
