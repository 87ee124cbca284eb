#pragma once
// Transfer functions whose positions mean the same on another cube: kept in data values, percentiles or
// robust sigmas above the median, and put onto a cube's own scale when they are used there.

#include <string>
#include <string_view>

#include "common/base/result.h"
#include "common/view/transfer_function.h"
#include "common/view/value_scale.h"

namespace shearwater::view {

struct AnchoredFunction {
    TransferFunction tf;  // its positions, and a hat's widths, in the unit
    Unit unit = Unit::stretched;
    // Colour pins in the unit too. Else they are a map's, which spans the limits of whatever cube it colours.
    bool own_colours = true;

    bool operator==(const AnchoredFunction&) const = default;
};

// The function in s, on a cube of this scale; null: of none that is known. A hat's feet and shoulders all
// come to lie where they belong. What falls together on the scale becomes a step.
base::Result<TransferFunction> on_scale(const AnchoredFunction& function, const ValueScale* scale);
// The way back, of a unit that the scale has.
AnchoredFunction anchored(const TransferFunction& tf, Unit unit, const ValueScale& scale);

// The TOML form of design section 3, with
//
//     density = 2.0         # multiplies the extinction; 1 unless set
//     [scale]
//     unit = "percentile"   # of x0, x1, centre, top, base, lean, lo, hi, at: stretched (unless set), value,
//     sigma
//
// An unknown key, kind or unit is refused by name.
base::Result<AnchoredFunction> transfer_function_from_toml(std::string_view text, std::string_view source);
// `within`: the table of a larger document that the text stands in, whose heading is written before it.
std::string to_toml(const AnchoredFunction& function, const std::string& within = {});

}  // namespace shearwater::view
