#include "common/image/stereo_modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace shearwater::image {
namespace {

Image<Rgba8> noise(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    Image<Rgba8> image(width, height);
    for (Rgba8& pixel : image.pixels()) {
        const auto any = [&] { return static_cast<std::uint8_t>(random() % 256); };
        pixel = {any(), any(), any(), 255};
    }
    return image;
}

Image<Rgba8> plain(const Rgba8& pixel) {
    Image<Rgba8> image(3, 2);
    std::ranges::fill(image.pixels(), pixel);
    return image;
}

Rgba8 anaglyph_of(const Rgba8& left, const Rgba8& right) {
    return composed(plain(left), plain(right), StereoMode::anaglyph).at(1, 1);
}

TEST(StereoModes, HaveNames) {
    for (std::size_t n = 0; n < stereo_mode_names.size(); ++n) {
        EXPECT_EQ(stereo_mode(stereo_mode_names[n]), static_cast<StereoMode>(n));
    }
    EXPECT_EQ(stereo_mode("off"), std::nullopt);
    EXPECT_EQ(stereo_mode(""), std::nullopt);
}

TEST(StereoModes, PutEveryPixelInItsPlace) {
    const auto left = noise(7, 5, 1), right = noise(7, 5, 2);
    const auto beside = composed(left, right, StereoMode::side_by_side);
    const auto below = composed(left, right, StereoMode::top_bottom);
    const auto rows = composed(left, right, StereoMode::interlaced);
    for (const StereoMode apart : {StereoMode::quad_buffered, StereoMode::two_windows}) {
        const auto picture = composed(left, right, apart);
        EXPECT_TRUE(std::ranges::equal(beside.pixels(), picture.pixels()));
    }
    ASSERT_EQ(beside.width(), 14);
    ASSERT_EQ(beside.height(), 5);
    ASSERT_EQ(below.width(), 7);
    ASSERT_EQ(below.height(), 10);
    ASSERT_EQ(rows.width(), 7);
    ASSERT_EQ(rows.height(), 5);
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 7; ++x) {
            EXPECT_EQ(beside.at(x, y), left.at(x, y));
            EXPECT_EQ(beside.at(7 + x, y), right.at(x, y));
            EXPECT_EQ(below.at(x, y), left.at(x, y));
            EXPECT_EQ(below.at(x, 5 + y), right.at(x, y));
            EXPECT_EQ(rows.at(x, y), (y % 2 == 0 ? left : right).at(x, y));
            EXPECT_EQ(composed(left, right, StereoMode::left).at(x, y), left.at(x, y));
            EXPECT_EQ(composed(left, right, StereoMode::right).at(x, y), right.at(x, y));
        }
    }
}

TEST(StereoModes, HaveTheSizeTheySay) {
    for (std::size_t n = 0; n < stereo_mode_names.size(); ++n) {
        const auto mode = static_cast<StereoMode>(n);
        const auto picture = composed(noise(6, 4, 3), noise(6, 4, 4), mode);
        EXPECT_EQ((view::ImageSize{picture.width(), picture.height()}), composed_size({6, 4}, mode));
    }
}

// What both eyes see alike, and has no colour, stays so.
TEST(Anaglyph, OfAGreyPairIsThatGrey) {
    for (int grey = 0; grey < 256; ++grey) {
        const auto g = static_cast<std::uint8_t>(grey);
        const Rgba8 shown = anaglyph_of({g, g, g, 255}, {g, g, g, 255});
        EXPECT_NEAR(shown.r, grey, 1);
        EXPECT_NEAR(shown.g, grey, 1);
        EXPECT_NEAR(shown.b, grey, 1);
    }
}

TEST(Anaglyph, GivesEachEyeItsFilter) {
    const Rgba8 white{255, 255, 255, 255}, black{0, 0, 0, 255};
    const Rgba8 for_left = anaglyph_of(white, black), for_right = anaglyph_of(black, white);
    EXPECT_EQ(for_left, (Rgba8{255, 0, 0, 255}));
    EXPECT_EQ(for_right, (Rgba8{0, 255, 255, 255}));
}

// Nothing reaches its channel that the other eye alone sees: what leaks is taken away.
TEST(Anaglyph, TakesAwayWhatLeaks) {
    const Rgba8 grey{128, 128, 128, 255}, white{255, 255, 255, 255}, black{0, 0, 0, 255};
    EXPECT_LT(anaglyph_of(grey, white).r, anaglyph_of(grey, black).r);
    EXPECT_LT(anaglyph_of(white, grey).g, anaglyph_of(black, grey).g);
    EXPECT_LT(anaglyph_of(white, grey).b, anaglyph_of(black, grey).b);
}

// By the definition: matrices over light, as sRGB codes stand for it.
TEST(Anaglyph, MixesLight) {
    const auto light = [](double code) {
        return code <= 0.04045 * 255 ? code / 255 / 12.92 : std::pow((code / 255 + 0.055) / 1.055, 2.4);
    };
    const Rgba8 l{200, 40, 90, 255}, r{10, 120, 60, 255};
    const double red = 0.437 * light(200) + 0.449 * light(40) + 0.164 * light(90) - 0.011 * light(10) -
                       0.032 * light(120) - 0.007 * light(60);
    EXPECT_NEAR(light(anaglyph_of(l, r).r), red, 0.004);
}

}  // namespace
}  // namespace shearwater::image
