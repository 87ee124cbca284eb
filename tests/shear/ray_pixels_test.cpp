#include "renderer/shear/ray_pixels.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <random>
#include <vector>

namespace shearwater::shear {
namespace {

// What so many rays gathered from the third of a row on, and their pixels.
void expect_pixels(std::size_t count, const view::Rgb* hue) {
    constexpr std::ptrdiff_t first = 3;
    constexpr float done = 0.9F;
    std::mt19937 random(static_cast<unsigned>(count));
    std::uniform_real_distribution<float> opacity(0, 1);
    std::array<std::vector<float>, 4> planes;
    for (auto& plane : planes) {
        plane.resize(first + count);
    }
    for (std::size_t n = 0; n < first + count; ++n) {
        planes[3][n] = n % 5 == 1 ? 0 : opacity(random);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            planes[channel][n] = planes[3][n] * opacity(random);
        }
    }
    const Rays rays{.r = planes[0].data(),
                    .g = planes[1].data(),
                    .b = planes[2].data(),
                    .a = planes[3].data(),
                    .stride = 0,
                    .done = done};
    constexpr image::RgbaF untouched{7, 7, 7, 7};
    std::vector<image::RgbaF> out(count + 1, untouched);
    pixels_of(rays, first, hue, std::span(out).first(count));
    EXPECT_EQ(out.back().r, untouched.r);
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t ray = first + n;
        const float a = planes[3][ray];
        const float whole = a >= done ? 1 / a : 1;
        const auto colour = [&](std::size_t channel, double of_hue) {
            return hue != nullptr ? planes[0][ray] * whole * static_cast<float>(of_hue)
                                  : planes[channel][ray] * whole;
        };
        EXPECT_FLOAT_EQ(out[n].r, colour(0, hue != nullptr ? hue->r : 0)) << n << " of " << count;
        EXPECT_FLOAT_EQ(out[n].g, colour(1, hue != nullptr ? hue->g : 0)) << n << " of " << count;
        EXPECT_FLOAT_EQ(out[n].b, colour(2, hue != nullptr ? hue->b : 0)) << n << " of " << count;
        EXPECT_EQ(out[n].a, a >= done ? 1 : a) << n << " of " << count;
    }
}

TEST(RayPixels, AreWhatRaysGatheredAndOpaqueWhereTheyAreDone) {
    const view::Rgb hue{0.25, 0.5, 1};
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        for (const std::size_t count : {1U, 3U, 4U, 7U, 8U, 15U, 16U, 17U, 64U, 127U, 128U}) {
            expect_pixels(count, nullptr);
            expect_pixels(count, &hue);
        }
    }
    hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace shearwater::shear
