#pragma once
// Units of world coordinates, however headers spell them.

#include <string>
#include <string_view>

namespace shearwater::fits {

enum class Quantity { other, angle, speed, frequency, length, energy };

struct Unit {
    Quantity quantity = Quantity::other;
    double in_si = 1;   // degrees for angles
    std::string shown;  // printable
};
// What is not known is of another quantity, and shown as it is written.
Unit unit_of(std::string_view written);
// "deg", "m/s", "Hz", "m", "J"; empty for other quantities.
std::string_view si_unit(Quantity quantity);

// The unit to show values of a size in that are in the SI unit: the header's own, but for speeds (km/s), and
// where that is the SI unit of a frequency or a length, one in which they are no long numbers.
Unit unit_to_show(const Unit& header, double size);

}  // namespace shearwater::fits
