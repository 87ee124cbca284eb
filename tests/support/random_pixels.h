#pragma once
// Pixels by chance for what is true of every pixel, colours premultiplied, 0 <= r, g, b <= a <= 1; and how
// near two are to one another.

#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <vector>

#include "common/image/image.h"

namespace shearwater::support {

inline image::RgbaF random_pixel(std::mt19937& random) {
    std::uniform_real_distribution<float> unit(0, 1);
    const float a = unit(random);
    return {a * unit(random), a * unit(random), a * unit(random), a};
}

inline std::vector<image::RgbaF> random_pixels(std::mt19937& random, std::size_t count) {
    std::vector<image::RgbaF> pixels(count);
    for (image::RgbaF& pixel : pixels) {
        pixel = random_pixel(random);
    }
    return pixels;
}

inline void expect_near(const image::RgbaF& p, const image::RgbaF& q, float tolerance) {
    EXPECT_NEAR(p.r, q.r, tolerance);
    EXPECT_NEAR(p.g, q.g, tolerance);
    EXPECT_NEAR(p.b, q.b, tolerance);
    EXPECT_NEAR(p.a, q.a, tolerance);
}

}  // namespace shearwater::support
