#pragma once
// The warp's inner loop: a row of the picture, or a part of one, out of one face.

#include <cstddef>
#include <span>

#include "common/image/layer.h"
#include "common/image/resample.h"

namespace shearwater::image {

// Where the points of a row of the picture lie in a face: a straight line, gone along as perspective has it.
// The point px is at ((i + px * i_x) / (w + px * w_x), (j + px * j_x) / (w + px * w_x)).
//
// In views along an axis many points lie on the very borders of cells. Lest the last bit of a sum should
// choose the cell, places are rounded to 2^-30 of a pixel.
struct Track {
    double i = 0, i_x = 0, j = 0, j_x = 0, w = 1, w_x = 0;

    // Added and taken away again, it leaves as many bits.
    static constexpr double rounder = 0x1.8p22;
    Place at(double px) const {
        const double unit = 1 / (w + px * w_x);
        return {(i + px * i_x) * unit + rounder - rounder, (j + px * j_x) * unit + rounder - rounder};
    }
};

// Resamples the layer at the centres of pixels x0, x0 + 1, ... of a row, into `out`, which is transparent
// before. The few pixels beside the cube's outline, or the window's edge, are left for resample(): they are
// counted, and named in `left` (of out's size) by their place in `out`.
std::size_t resample_span(const Layer& layer, const Track& track, int x0, std::span<RgbaF> out,
                          std::span<int> left);

}  // namespace shearwater::image
