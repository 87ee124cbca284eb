#include "common/image/over.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/random_pixels.h"

namespace shearwater::image {
namespace {

using support::expect_near;
using support::random_pixels;

TEST(Over, FollowsEquations4And5) {
    std::vector<RgbaF> front{{0.2F, 0.1F, 0, 0.25F}};
    over(front, std::vector<RgbaF>{{0.4F, 0.8F, 0.04F, 0.8F}});
    expect_near(front[0], {0.2F + 0.75F * 0.4F, 0.1F + 0.75F * 0.8F, 0.75F * 0.04F, 0.25F + 0.75F * 0.8F},
                1e-7F);
}

TEST(Over, IsAssociativeAndNotCommutative) {
    std::mt19937 random(1);
    for (const std::size_t count : {1U, 2U, 3U, 7U, 64U, 101U}) {
        const auto a = random_pixels(random, count), b = random_pixels(random, count),
                   c = random_pixels(random, count);
        auto left = a;
        over(left, b);
        over(left, c);
        auto inner = b;
        over(inner, c);
        auto right = a;
        over(right, inner);
        auto swapped = b;
        over(swapped, a);
        auto plain = a;
        over(plain, b);
        float difference = 0;
        for (std::size_t i = 0; i < count; ++i) {
            expect_near(left[i], right[i], 1e-6F);
            difference += std::abs(swapped[i].r - plain[i].r);
        }
        EXPECT_GT(difference, 1e-5F);
    }
}

TEST(Over, OfTravelledPixelsIsThatOfTheirValues) {
    std::mt19937 random(2);
    auto front = random_pixels(random, 33);
    const auto back = random_pixels(random, 33);
    std::vector<Rgba16> travelled(33);
    to_16_bits(back, travelled);
    auto expected = front;
    over(expected, back);
    over(front, travelled);
    for (std::size_t i = 0; i < front.size(); ++i) {
        expect_near(front[i], expected[i], 1.0F / 65535);
    }
}

TEST(SixteenBits, RoundToTheNearestLevelAndBack) {
    const std::vector<RgbaF> pixels{{0, 1, 0.5F, 1.0F / 65535}, {-0.1F, 1.5F, 0.49F / 65535, 0.51F / 65535}};
    std::vector<Rgba16> levels(2);
    to_16_bits(pixels, levels);
    EXPECT_EQ(levels[0], (Rgba16{0, 65535, 32768, 1}));
    EXPECT_EQ(levels[1], (Rgba16{0, 65535, 0, 1}));
    for (unsigned level = 0; level <= 65535; ++level) {
        const auto l = static_cast<std::uint16_t>(level);
        const std::vector<Rgba16> from{{l, l, l, l}};
        std::vector<RgbaF> as_float(1);
        std::vector<Rgba16> again(1);
        from_16_bits(from, as_float);
        to_16_bits(as_float, again);
        ASSERT_EQ(again[0], from[0]);
    }
}

}  // namespace
}  // namespace shearwater::image
