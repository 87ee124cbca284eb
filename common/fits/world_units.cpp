#include "common/fits/world_units.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "common/base/result.h"

namespace shearwater::fits {

namespace {

constexpr double degrees_a_radian = 57.295779513082323;
constexpr double joules_an_electronvolt = 1.602176634e-19;

struct Known {
    std::string_view spelling;  // in lower case
    Quantity quantity;
    double in_si;
    std::string_view shown;
};
constexpr std::array known{
    Known{"deg", Quantity::angle, 1, "deg"},
    Known{"degree", Quantity::angle, 1, "deg"},
    Known{"degrees", Quantity::angle, 1, "deg"},
    Known{"arcmin", Quantity::angle, 1.0 / 60, "arcmin"},
    Known{"arcsec", Quantity::angle, 1.0 / 3600, "arcsec"},
    Known{"mas", Quantity::angle, 1.0 / 3600000, "mas"},
    Known{"rad", Quantity::angle, degrees_a_radian, "rad"},
    Known{"radian", Quantity::angle, degrees_a_radian, "rad"},
    Known{"m/s", Quantity::speed, 1, "m/s"},
    Known{"m s-1", Quantity::speed, 1, "m/s"},
    Known{"m.s-1", Quantity::speed, 1, "m/s"},
    Known{"m s**-1", Quantity::speed, 1, "m/s"},
    Known{"m/sec", Quantity::speed, 1, "m/s"},
    Known{"km/s", Quantity::speed, 1e3, "km/s"},
    Known{"km s-1", Quantity::speed, 1e3, "km/s"},
    Known{"km.s-1", Quantity::speed, 1e3, "km/s"},
    Known{"km s**-1", Quantity::speed, 1e3, "km/s"},
    Known{"km/sec", Quantity::speed, 1e3, "km/s"},
    Known{"cm/s", Quantity::speed, 1e-2, "cm/s"},
    Known{"hz", Quantity::frequency, 1, "Hz"},
    Known{"khz", Quantity::frequency, 1e3, "kHz"},
    Known{"mhz", Quantity::frequency, 1e6, "MHz"},
    Known{"ghz", Quantity::frequency, 1e9, "GHz"},
    Known{"thz", Quantity::frequency, 1e12, "THz"},
    Known{"m", Quantity::length, 1, "m"},
    Known{"cm", Quantity::length, 1e-2, "cm"},
    Known{"mm", Quantity::length, 1e-3, "mm"},
    Known{"um", Quantity::length, 1e-6, "um"},
    Known{"micron", Quantity::length, 1e-6, "um"},
    Known{"microns", Quantity::length, 1e-6, "um"},
    Known{"nm", Quantity::length, 1e-9, "nm"},
    Known{"angstrom", Quantity::length, 1e-10, "Angstrom"},
    Known{"angstroms", Quantity::length, 1e-10, "Angstrom"},
    Known{"j", Quantity::energy, 1, "J"},
    Known{"ev", Quantity::energy, joules_an_electronvolt, "eV"},
    Known{"kev", Quantity::energy, 1e3 * joules_an_electronvolt, "keV"},
    Known{"mev", Quantity::energy, 1e6 * joules_an_electronvolt, "MeV"},
    Known{"gev", Quantity::energy, 1e9 * joules_an_electronvolt, "GeV"},
    Known{"tev", Quantity::energy, 1e12 * joules_an_electronvolt, "TeV"},
};

}  // namespace

Unit unit_of(std::string_view written) {
    std::string lower(written);
    std::ranges::transform(lower, lower.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto* const found = std::ranges::find(known, std::string_view(lower), &Known::spelling);
    if (found == known.end()) {
        return {.shown = base::printable(written, 20)};
    }
    return {found->quantity, found->in_si, std::string(found->shown)};
}

std::string_view si_unit(Quantity quantity) {
    constexpr std::array<std::string_view, 6> names{"", "deg", "m/s", "Hz", "m", "J"};
    return names.at(static_cast<std::size_t>(quantity));
}

Unit unit_to_show(const Unit& header, double size) {
    if (header.quantity == Quantity::speed) {
        return unit_of("km/s");
    }
    if (header.quantity == Quantity::frequency && header.in_si == 1) {
        return unit_of(size >= 1e9 ? "ghz" : size >= 1e6 ? "mhz" : size >= 1e3 ? "khz" : "hz");
    }
    if (header.quantity == Quantity::length && header.in_si == 1) {
        return unit_of(size >= 1 ? "m" : size >= 1e-3 ? "mm" : size >= 1e-6 ? "um" : "nm");
    }
    return header;
}

}  // namespace shearwater::fits
