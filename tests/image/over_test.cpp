#include "common/image/over.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace shearwater::image {
namespace {

RgbaF random_pixel(std::mt19937& random) {
    std::uniform_real_distribution<float> unit(0, 1);
    const float a = unit(random);
    return {a * unit(random), a * unit(random), a * unit(random), a};
}

std::vector<RgbaF> random_pixels(std::mt19937& random, std::size_t count) {
    std::vector<RgbaF> pixels(count);
    for (RgbaF& pixel : pixels) {
        pixel = random_pixel(random);
    }
    return pixels;
}

void expect_near(const RgbaF& p, const RgbaF& q, float tolerance) {
    EXPECT_NEAR(p.r, q.r, tolerance);
    EXPECT_NEAR(p.g, q.g, tolerance);
    EXPECT_NEAR(p.b, q.b, tolerance);
    EXPECT_NEAR(p.a, q.a, tolerance);
}

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

Window window_of(int face, const Rect& rect, const RgbaF& pixel) {
    Window window{.face = face, .rect = rect, .pixels = Image<RgbaF>(rect.width(), rect.height())};
    std::fill(window.pixels.pixels().begin(), window.pixels.pixels().end(), pixel);
    return window;
}

TEST(Merge, PutsEachWindowWhereItBelongs) {
    const RgbaF red{0.5F, 0, 0, 0.5F}, green{0, 0.5F, 0, 0.5F};
    std::vector<Window> windows;
    windows.push_back(window_of(1, {2, 3, 5, 6}, red));
    windows.push_back(window_of(0, {-4, 0, -1, 2}, green));
    windows.push_back(window_of(1, {4, 4, 9, 5}, green));
    windows.push_back(window_of(1, {0, 0, 0, 0}, red));
    const auto merged = merge_front_to_back(windows);
    ASSERT_EQ(merged.size(), 2U);
    EXPECT_EQ(merged[0].face, 1);
    EXPECT_EQ(merged[0].rect, (Rect{2, 3, 9, 6}));
    expect_near(merged[0].pixels.at(0, 0), red, 0);
    expect_near(merged[0].pixels.at(2, 1), {0.5F, 0.25F, 0, 0.75F}, 1e-7F);  // red over green
    expect_near(merged[0].pixels.at(6, 1), green, 0);
    expect_near(merged[0].pixels.at(6, 0), {}, 0);
    EXPECT_EQ(merged[1].face, 0);
    EXPECT_EQ(merged[1].rect, (Rect{-4, 0, -1, 2}));
}

TEST(Merge, OfTravelledWindowsIsTheSame) {
    std::mt19937 random(4);
    std::vector<Window> windows;
    std::vector<std::vector<Rgba16>> travelled;
    std::vector<WindowView16> views;
    for (int n = 0; n < 9; ++n) {
        const int x = static_cast<int>(random() % 20), y = static_cast<int>(random() % 20);
        windows.push_back(window_of(n % 2, {x, y, x + 1 + n, y + 10 - n}, random_pixel(random)));
        travelled.emplace_back(windows.back().pixels.pixels().size());
        to_16_bits(windows.back().pixels.pixels(), travelled.back());
        views.push_back({windows.back().face, windows.back().rect, travelled.back()});
    }
    const auto a = merge_front_to_back(windows);
    const auto b = merge_front_to_back(views);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t w = 0; w < a.size(); ++w) {
        ASSERT_EQ(a[w].rect, b[w].rect);
        for (std::size_t i = 0; i < a[w].pixels.pixels().size(); ++i) {
            expect_near(a[w].pixels.pixels()[i], b[w].pixels.pixels()[i], 9.0F / 65535);
        }
    }
    EXPECT_TRUE(merge_front_to_back(std::span<const Window>{}).empty());
}

}  // namespace
}  // namespace shearwater::image
