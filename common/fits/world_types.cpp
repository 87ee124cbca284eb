#include "common/fits/world_types.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "common/base/result.h"

namespace shearwater::fits {

namespace {

using wcs::Notation;

struct KnownType {
    std::string_view type;  // what stands before the first "-"
    std::string_view name, label;
    Quantity quantity;
    Notation notation = Notation::plain;
    bool circle = false;
};
constexpr std::array known_types{
    KnownType{"RA", "right ascension", "RA", Quantity::angle, Notation::hours, true},
    KnownType{"DEC", "declination", "Dec", Quantity::angle, Notation::degrees},
    KnownType{"GLON", "galactic longitude", "GLon", Quantity::angle, Notation::plain, true},
    KnownType{"GLAT", "galactic latitude", "GLat", Quantity::angle},
    KnownType{"ELON", "ecliptic longitude", "ELon", Quantity::angle, Notation::plain, true},
    KnownType{"ELAT", "ecliptic latitude", "ELat", Quantity::angle},
    KnownType{"SLON", "supergalactic longitude", "SGLon", Quantity::angle, Notation::plain, true},
    KnownType{"SLAT", "supergalactic latitude", "SGLat", Quantity::angle},
    KnownType{"HLON", "helioecliptic longitude", "HLon", Quantity::angle, Notation::plain, true},
    KnownType{"HLAT", "helioecliptic latitude", "HLat", Quantity::angle},
    KnownType{"HPLN", "helioprojective longitude", "HPLn", Quantity::angle},
    KnownType{"HPLT", "helioprojective latitude", "HPLt", Quantity::angle},
    KnownType{"FREQ", "frequency", "Freq", Quantity::frequency},
    KnownType{"VELO", "velocity", "Vel", Quantity::speed},
    KnownType{"VRAD", "radio velocity", "Vel", Quantity::speed},
    KnownType{"VOPT", "optical velocity", "Vel", Quantity::speed},
    KnownType{"FELO", "optical velocity", "Vel", Quantity::speed},
    KnownType{"WAVE", "wavelength", "Wave", Quantity::length},
    KnownType{"AWAV", "wavelength in air", "Wave", Quantity::length},
    KnownType{"ENER", "energy", "Energy", Quantity::energy},
};

std::string upper(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return result;
}

// What a unit says of a type that says nothing.
void name_by_unit(WorldType& type, Quantity quantity) {
    constexpr std::array<std::string_view, 6> names{"linear",    "angle",      "velocity",
                                                    "frequency", "wavelength", "energy"};
    constexpr std::array<std::string_view, 6> labels{"Linear", "Angle", "Vel", "Freq", "Wave", "Energy"};
    type.name = names.at(static_cast<std::size_t>(quantity));
    type.label = labels.at(static_cast<std::size_t>(quantity));
}

}  // namespace

WorldType world_type(std::string_view written, const Unit& unit) {
    const std::string type = upper(written);
    const std::string_view first = std::string_view(type).substr(0, type.find('-'));
    WorldType result;
    const auto* const found = std::ranges::find(known_types, first, &KnownType::type);
    if (found == known_types.end()) {
        result.quantity = unit.quantity;
        if (type == "LINEAR") {
            name_by_unit(result, unit.quantity);
        } else {
            result.name = base::printable(written, 40);
            result.label = base::printable(written, 12);
        }
        return result;
    }
    result.name = found->name;
    result.label = found->label;
    result.quantity = found->quantity;
    result.celestial = found->quantity == Quantity::angle && type.size() >= 8;
    result.spectral = found->quantity != Quantity::angle;
    // Without a projection there is no circle either: a header's numbers are offsets as likely as not.
    if (result.celestial) {
        result.notation = found->notation;
        result.circle = found->circle;
    }
    if (result.celestial || result.spectral) {
        result.code = type.substr(0, 8);
        result.distorted = type.size() > 8 || result.code.ends_with("-TPV");
        if (result.code.ends_with("-TPV")) {
            result.code.replace(5, 3, "TAN");
        }
    }
    return result;
}

}  // namespace shearwater::fits
