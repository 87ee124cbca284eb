#include "common/fits/world_units.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "common/base/result.h"

namespace shearwater::fits {

namespace {

constexpr double degrees_a_radian = 57.295779513082323;
constexpr double joules_an_electronvolt = 1.602176634e-19;

struct KnownUnit {
    std::string_view spelling;  // in lower case
    Quantity quantity;
    double in_si;
    std::string_view shown;
};
constexpr std::array known_units{
    KnownUnit{"deg", Quantity::angle, 1, "deg"},
    KnownUnit{"degree", Quantity::angle, 1, "deg"},
    KnownUnit{"degrees", Quantity::angle, 1, "deg"},
    KnownUnit{"arcmin", Quantity::angle, 1.0 / 60, "arcmin"},
    KnownUnit{"arcsec", Quantity::angle, 1.0 / 3600, "arcsec"},
    KnownUnit{"mas", Quantity::angle, 1.0 / 3600000, "mas"},
    KnownUnit{"rad", Quantity::angle, degrees_a_radian, "rad"},
    KnownUnit{"radian", Quantity::angle, degrees_a_radian, "rad"},
    KnownUnit{"m/s", Quantity::speed, 1, "m/s"},
    KnownUnit{"m s-1", Quantity::speed, 1, "m/s"},
    KnownUnit{"m.s-1", Quantity::speed, 1, "m/s"},
    KnownUnit{"m s**-1", Quantity::speed, 1, "m/s"},
    KnownUnit{"m/sec", Quantity::speed, 1, "m/s"},
    KnownUnit{"km/s", Quantity::speed, 1e3, "km/s"},
    KnownUnit{"km s-1", Quantity::speed, 1e3, "km/s"},
    KnownUnit{"km.s-1", Quantity::speed, 1e3, "km/s"},
    KnownUnit{"km s**-1", Quantity::speed, 1e3, "km/s"},
    KnownUnit{"km/sec", Quantity::speed, 1e3, "km/s"},
    KnownUnit{"cm/s", Quantity::speed, 1e-2, "cm/s"},
    KnownUnit{"hz", Quantity::frequency, 1, "Hz"},
    KnownUnit{"khz", Quantity::frequency, 1e3, "kHz"},
    KnownUnit{"mhz", Quantity::frequency, 1e6, "MHz"},
    KnownUnit{"ghz", Quantity::frequency, 1e9, "GHz"},
    KnownUnit{"thz", Quantity::frequency, 1e12, "THz"},
    KnownUnit{"m", Quantity::length, 1, "m"},
    KnownUnit{"cm", Quantity::length, 1e-2, "cm"},
    KnownUnit{"mm", Quantity::length, 1e-3, "mm"},
    KnownUnit{"um", Quantity::length, 1e-6, "um"},
    KnownUnit{"micron", Quantity::length, 1e-6, "um"},
    KnownUnit{"microns", Quantity::length, 1e-6, "um"},
    KnownUnit{"nm", Quantity::length, 1e-9, "nm"},
    KnownUnit{"angstrom", Quantity::length, 1e-10, "Angstrom"},
    KnownUnit{"angstroms", Quantity::length, 1e-10, "Angstrom"},
    KnownUnit{"j", Quantity::energy, 1, "J"},
    KnownUnit{"ev", Quantity::energy, joules_an_electronvolt, "eV"},
    KnownUnit{"kev", Quantity::energy, 1e3 * joules_an_electronvolt, "keV"},
    KnownUnit{"mev", Quantity::energy, 1e6 * joules_an_electronvolt, "MeV"},
    KnownUnit{"gev", Quantity::energy, 1e9 * joules_an_electronvolt, "GeV"},
    KnownUnit{"tev", Quantity::energy, 1e12 * joules_an_electronvolt, "TeV"},
};

}  // namespace

Unit unit_of(std::string_view written) {
    std::string lower(written);
    std::ranges::transform(lower, lower.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto* const found = std::ranges::find(known_units, std::string_view(lower), &KnownUnit::spelling);
    if (found == known_units.end()) {
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
