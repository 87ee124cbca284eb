#pragma once
// What CTYPE says is measured along an axis.

#include <string>
#include <string_view>

#include "common/fits/world_units.h"
#include "common/wcs/axis.h"

namespace shearwater::fits {

struct WorldType {
    std::string name, label;  // printable
    Quantity quantity = Quantity::other;
    wcs::Notation notation = wcs::Notation::plain;
    bool circle = false;
    bool celestial = false;  // by a projection of the sky, with another axis
    bool spectral = false;
    // Those of the standard, for wcslib: eight characters. Empty for what is linear.
    std::string code;
    bool distorted = false;  // the type tells of a distortion, which is left out of the code
};

// Of the type and the unit: "LINEAR" in Angstrom is a wavelength. Empty names where the header has no type.
WorldType world_type(std::string_view type, const Unit& unit);

}  // namespace shearwater::fits
