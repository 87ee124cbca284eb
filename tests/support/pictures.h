#pragma once
// Comparing pictures.

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/image/image.h"

namespace shearwater::support {

struct Difference {
    int largest = 0;                                        // of any channel, in 1/255
    double psnr = std::numeric_limits<double>::infinity();  // decibels over the three colours
};

// Of two pictures of one size.
inline Difference difference(const image::Image<image::Rgba8>& a, const image::Image<image::Rgba8>& b) {
    base::check(a.width() == b.width() && a.height() == b.height(), "pictures of one size are compared");
    Difference result;
    double squares = 0;
    const auto add = [&](int x, int y) {
        result.largest = std::max(result.largest, std::abs(x - y));
        squares += (x - y) * (x - y);
    };
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        add(a.pixels()[i].r, b.pixels()[i].r);
        add(a.pixels()[i].g, b.pixels()[i].g);
        add(a.pixels()[i].b, b.pixels()[i].b);
    }
    const double mean = squares / (3.0 * static_cast<double>(a.pixels().size()));
    if (mean > 0) {
        result.psnr = 10 * std::log10(255.0 * 255.0 / mean);
    }
    return result;
}

// Whether anything but black is there.
inline bool lit(const image::Image<image::Rgba8>& picture) {
    return std::ranges::any_of(picture.pixels(),
                               [](const image::Rgba8& p) { return p.r > 8 || p.g > 8 || p.b > 8; });
}

}  // namespace shearwater::support
