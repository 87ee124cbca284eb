#pragma once
// Which pixels' samples lie between two planes of voxels.

#include <algorithm>

#include "common/view/factorisation.h"

namespace shearwater::shear {

// Of a range of pixels those whose samples lie in the voxels [lo, hi), or on the sub-volume's side of an end
// of it where `open`. Neighbours' ranges meet.
inline view::PixelRange pixels_within(const view::PixelRange& range, double offset, double scale, double lo,
                                      double hi, bool open_lo, bool open_hi) {
    const double pixels = 1 / scale;  // a voxel
    const auto boundary = [&](double voxel) {
        // Up to the next: what is not below 0 is cut off by conversion.
        const double at = std::clamp((voxel - offset) * pixels, static_cast<double>(range.first),
                                     static_cast<double>(range.last));
        const int below = static_cast<int>(at);
        return below + (static_cast<double>(below) < at ? 1 : 0);
    };
    if (scale > 0) {
        return {open_lo ? range.first : boundary(lo), open_hi ? range.last : boundary(hi)};
    }
    return {open_hi ? range.first : boundary(hi), open_lo ? range.last : boundary(lo)};
}

}  // namespace shearwater::shear
