// Loops over pixels give what one pixel's formula gives, on every set of instructions at hand, for any number
// of pixels from any address on, and touch no others.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "common/image/finish.h"
#include "common/image/lit_blocks.h"
#include "common/image/over.h"
#include "common/image/rle.h"
#include "tests/support/random_pixels.h"
#include "tests/support/simd_targets.h"

namespace shearwater::image {
namespace {

using support::for_each_target;
using support::random_pixel;

// Some of them transparent, or out of what a pixel can be.
std::vector<RgbaF> wild_pixels(std::mt19937& random, std::size_t count) {
    std::vector<RgbaF> pixels(count);
    for (RgbaF& pixel : pixels) {
        const auto kind = random() % 8;
        pixel = kind == 0 ? RgbaF{} : kind == 1 ? RgbaF{-0.5F, 1.5F, 1, 2} : random_pixel(random);
    }
    return pixels;
}

std::vector<Rgba16> random_levels(std::mt19937& random, std::size_t count) {
    std::vector<Rgba16> levels(count);
    for (Rgba16& pixel : levels) {
        const auto level = [&] { return static_cast<std::uint16_t>(random()); };
        pixel = {level(), level(), level(), random() % 4 == 0 ? std::uint16_t{65535} : level()};
    }
    return levels;
}

double channel(const RgbaF& p, int c) {
    return static_cast<double>(c == 0 ? p.r : c == 1 ? p.g : c == 2 ? p.b : p.a);
}
double channel(const Rgba16& p, int c) {
    return (c == 0 ? p.r : c == 1 ? p.g : c == 2 ? p.b : p.a) / 65535.0;
}

// Calls body(random, width) with every target, for all small widths and some larger.
void for_widths(const std::function<void(std::mt19937&, std::size_t)>& body) {
    for_each_target([&] {
        std::mt19937 random(6);
        for (std::size_t width = 0; width < 300; width += width < 40 ? 1 : 37) {
            body(random, width);
        }
    });
}

template <class Pixel>
void expect_over(const std::vector<RgbaF>& before, const std::vector<Pixel>& back, std::size_t at,
                 std::size_t width) {
    auto front = before;
    over(std::span(front).subspan(at, width), std::span(back).subspan(at + 1, width));
    for (std::size_t n = 0; n < front.size(); ++n) {
        for (int c = 0; c < 4; ++c) {
            const bool within = at <= n && n < at + width;
            const double through = within ? 1 - channel(before[n], 3) : 0;
            const double behind = within ? channel(back[n + 1], c) : 0;
            ASSERT_NEAR(channel(front[n], c), channel(before[n], c) + through * behind, 1e-6) << n;
        }
    }
}

TEST(Kernels, OverFollowsItsEquations) {
    for_widths([](std::mt19937& random, std::size_t width) {
        const auto front = wild_pixels(random, width + 3);
        expect_over(front, wild_pixels(random, width + 4), random() % 3, width);
        expect_over(front, random_levels(random, width + 4), random() % 3, width);
    });
}

TEST(Kernels, SixteenBitsAreTheNearestLevelAndBack) {
    for_widths([](std::mt19937& random, std::size_t width) {
        const auto pixels = wild_pixels(random, width + 1);
        const Rgba16 untouched{1, 2, 3, 4};
        std::vector<Rgba16> levels(width + 2, untouched);
        to_16_bits(std::span(pixels).subspan(1), std::span(levels).subspan(1, width));
        std::vector<RgbaF> back(width + 2, RgbaF{1, 2, 3, 4});
        from_16_bits(std::span(levels).subspan(1, width), std::span(back).subspan(1, width));
        for (std::size_t n = 1; n <= width; ++n) {
            for (int c = 0; c < 4; ++c) {
                const double wanted = std::clamp(channel(pixels[n], c), 0.0, 1.0);
                // A float has no more than 8 bits for what is below a level.
                ASSERT_NEAR(channel(levels[n], c), wanted, 0.504 / 65535) << n;
                ASSERT_NEAR(channel(back[n], c), channel(levels[n], c), 1e-7) << n;
            }
        }
        ASSERT_TRUE(levels.front() == untouched && levels.back() == untouched);
        ASSERT_TRUE(back.front().g == 2 && back.back().g == 2);
    });
}

TEST(Kernels, EveryLevelComesBack) {
    for_each_target([] {
        std::vector<Rgba16> levels(65536);
        for (std::size_t n = 0; n < levels.size(); ++n) {
            const auto level = static_cast<std::uint16_t>(n);
            levels[n] = {level, static_cast<std::uint16_t>(65535 - level), 0, level};
        }
        std::vector<RgbaF> floats(levels.size());
        std::vector<Rgba16> again(levels.size());
        from_16_bits(levels, floats);
        to_16_bits(floats, again);
        EXPECT_EQ(levels, again);
    });
}

TEST(Kernels, FinishGivesTheNearestLevelOverTheBackground) {
    const view::Rgb background{0.1, 0.7, 1};
    for_each_target([&] {
        std::mt19937 random(6);
        for (std::size_t width = 0; width < 70; ++width) {
            std::vector<RgbaF> pixels(width + 1);
            for (RgbaF& p : pixels) {
                p = random() % 4 == 0 ? RgbaF{} : random_pixel(random);
            }
            const auto from = std::span(pixels).subspan(1);
            std::vector<Rgba8> to(width + 3, Rgba8{1, 2, 3, 4});
            finish(from, background, std::span(to).subspan(1, width));
            for (std::size_t n = 0; n < width; ++n) {
                const double through = 1 - static_cast<double>(from[n].a);
                ASSERT_NEAR(to[n + 1].r, 255 * (static_cast<double>(from[n].r) + through * 0.1), 0.5001);
                ASSERT_NEAR(to[n + 1].g, 255 * (static_cast<double>(from[n].g) + through * 0.7), 0.5001);
                ASSERT_NEAR(to[n + 1].b, 255 * (static_cast<double>(from[n].b) + through), 0.5001);
                ASSERT_EQ(to[n + 1].a, 255);
                ASSERT_TRUE(from[n].a > 0 || to[n + 1] == (Rgba8{26, 179, 255, 255}));
            }
            ASSERT_EQ(to.front(), (Rgba8{1, 2, 3, 4}));
            ASSERT_EQ(to[width + 1], (Rgba8{1, 2, 3, 4}));
        }
    });
}

// The format, written down as plainly as can be.
std::vector<std::byte> coded_plainly(std::span<const Rgba8> pixels) {
    std::vector<std::byte> out;
    const auto put = [&](std::size_t value) { out.push_back(static_cast<std::byte>(value)); };
    const auto put_colour = [&](const Rgba8& p) { put(p.r), put(p.g), put(p.b); };
    const auto run_at = [&](std::size_t i) {
        std::size_t n = 1;
        while (i + n < pixels.size() && n < 66 + 0x3fff && pixels[i + n].r == pixels[i].r &&
               pixels[i + n].g == pixels[i].g && pixels[i + n].b == pixels[i].b) {
            ++n;
        }
        return n;
    };
    for (std::size_t i = 0; i < pixels.size();) {
        if (const std::size_t run = run_at(i); run >= 66) {
            put(0xc0 | ((run - 66) >> 8)), put((run - 66) & 0xff), put_colour(pixels[i]);
            i += run;
        } else if (run >= 2) {
            put(0x80 | (run - 2)), put_colour(pixels[i]);
            i += run;
        } else {
            std::size_t end = i + 1;
            while (end < pixels.size() && run_at(end) < 4) {
                ++end;
            }
            while (i < end) {
                std::size_t n = std::min<std::size_t>(128, end - i);
                put(n - 1);
                for (; n > 0; --n) {
                    put_colour(pixels[i++]);
                }
            }
        }
    }
    return out;
}

// Few colours that differ in one channel each, at every density of runs; alpha is anything.
std::vector<Rgba8> random_picture(std::mt19937& random) {
    std::vector<Rgba8> pixels;
    const auto longest = std::vector<std::size_t>{1, 3, 40, 300, 20000}[random() % 5];
    const auto runs = random() % (longest > 1000 ? 4 : 300);
    for (unsigned run = 0; run < runs; ++run) {
        const auto bit = [&] { return static_cast<std::uint8_t>(random() % 2); };
        const Rgba8 colour{bit(), bit(), bit(), 255};
        for (std::size_t n = 1 + random() % longest; n > 0; --n) {
            pixels.push_back({colour.r, colour.g, colour.b, static_cast<std::uint8_t>(random())});
        }
    }
    return pixels;
}

TEST(Kernels, RunLengthsAreTheFormatToTheByte) {
    for_each_target([] {
        std::mt19937 random(8);
        for (int round = 0; round < 300; ++round) {
            const auto pixels = random_picture(random);
            std::vector<std::byte> bytes(rle_bound(pixels.size()));
            bytes.resize(encode_rle(pixels, bytes));
            ASSERT_EQ(bytes, coded_plainly(pixels));
            std::vector<Rgba8> back(pixels.size() + 2);
            ASSERT_TRUE(decode_rle(bytes, std::span(back).subspan(1, pixels.size())));
            for (std::size_t n = 0; n < pixels.size(); ++n) {
                ASSERT_EQ(back[n + 1], (Rgba8{pixels[n].r, pixels[n].g, pixels[n].b, 255})) << n;
            }
            ASSERT_TRUE(back.front() == Rgba8{} && back.back() == Rgba8{});
        }
    });
}

// Rows with a few bright pixels, or many, noted in parts.
TEST(LitBlocks, NoneIsMissedAndEmptySkyIsTold) {
    std::mt19937 random(3);
    for (const int width : {1, 15, 16, 300, 1024, 2100}) {
        constexpr int height = 12;
        Image<RgbaF> image(width, height);
        LitBlocks blocks(width, height);
        for (int y = 0; y < height; ++y) {
            for (RgbaF& pixel : image.row(y)) {
                const bool lit = y % 3 == 0 ? random() % 200 == 0 : y % 3 == 1 && random() % 10 > 0;
                pixel = lit ? RgbaF{0, 0, 1e-30F, 0} : RgbaF{};
            }
            const int middle = static_cast<int>(random() % static_cast<unsigned>(width));
            const auto row = std::span(std::as_const(image).row(y));
            const Range left = blocks.note(0, y, row.first(static_cast<std::size_t>(middle)));
            const Range right = blocks.note(middle, y, row.subspan(static_cast<std::size_t>(middle)));
            for (int x = 0; x < width; ++x) {
                const bool in = left.contains(x) || right.contains(x);
                EXPECT_TRUE(in || image.at(x, y).b == 0) << x << ", " << y;
            }
        }
        int told = 0;
        for (int round = 0; round < 2000; ++round) {
            const auto number = [&](int below) {
                return static_cast<int>(random() % static_cast<unsigned>(below));
            };
            const int x = number(width + 9) - 5, y = number(height + 9) - 5;
            const Rect rect{x, y, x + number(90), y + number(5)};
            const Rect inside = view::intersection(rect, {0, 0, width, height});
            bool lit = false;
            for (int j = inside.y0; j < inside.y1; ++j) {
                for (int i = inside.x0; i < inside.x1; ++i) {
                    lit = lit || image.at(i, j).b != 0;
                }
            }
            const bool any = blocks.any(rect);
            EXPECT_TRUE(any || !lit) << x << ", " << y;
            // A row whose few pixels are all bright is taken for full.
            told += !any && !inside.empty() ? 1 : 0;
        }
        EXPECT_TRUE(told > 100 || width < 16) << "of a picture that is a third empty, " << told << " told";
    }
}

}  // namespace
}  // namespace shearwater::image
