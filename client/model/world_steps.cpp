#include "client/model/world_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace shearwater::model {

namespace {

constexpr double almost = 1 - 1e-9;

// Of what has 60 parts of 60 seconds; the last ones are wholes.
double sexagesimal_step(double least_seconds, std::span<const double> wholes) {
    if (least_seconds <= 1) {
        return round_step(least_seconds);
    }
    for (const double part : {1.0, 60.0}) {
        for (const double count : {1.0, 2.0, 5.0, 10.0, 15.0, 30.0}) {
            if (count * part >= least_seconds * almost) {
                return count * part;
            }
        }
    }
    for (const double whole : wholes) {
        if (whole * 3600 >= least_seconds * almost) {
            return whole * 3600;
        }
    }
    return wholes.back() * 3600;
}

}  // namespace

double round_step(double least) {
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= least * almost) {
            return factor * power;
        }
    }
    return 10 * power;
}

double world_step(const wcs::Axis& axis, double least) {
    constexpr std::array hours{1.0, 2.0, 3.0, 6.0, 12.0};
    constexpr std::array degrees{1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0};
    switch (axis.notation) {
        case wcs::Notation::hours:
            return sexagesimal_step(least * 240, hours) / 240;
        case wcs::Notation::degrees:
            return sexagesimal_step(least * 3600, degrees) / 3600;
        case wcs::Notation::plain:
            break;
    }
    if (axis.circle && least > 10) {
        const auto* const step = std::ranges::find_if(degrees, [&](double d) { return d >= least * almost; });
        return step != degrees.end() ? *step : degrees.back();
    }
    return round_step(least);
}

}  // namespace shearwater::model
