// From one transfer function to another.

#include "common/flight/blend.h"

#include <gtest/gtest.h>

namespace shearwater::flight {
namespace {

using view::TransferFunction;

TransferFunction of(std::vector<view::OpacityPin> pins, const char* map = "inferno") {
    return {.opacity_pins = std::move(pins), .colour_pins = view::colour_map(map).value(), .background = {}};
}

const TransferFunction ramp = of({view::Ramp{.x0 = 0.2, .a0 = 0, .x1 = 1, .a1 = 0.5}});
const TransferFunction hats = of({view::Hat{.centre = 0.3, .top = 0.1, .base = 0.2, .height = 0.8},
                                  view::Flat{.height = 0.01}, view::Blank{.lo = 0.7, .hi = 0.9}},
                                 "turbo");

TEST(Blend, BeginsAndEndsExactly) {
    EXPECT_EQ(blend(ramp, hats, 0), ramp);
    EXPECT_EQ(blend(ramp, hats, 1), hats);
    EXPECT_EQ(blend(hats, hats, 0.4), hats);
}

TEST(Blend, PinsOfTheSameKindsMove) {
    const auto to = of({view::Ramp{.x0 = 0.75, .a0 = 0.25, .x1 = 0.875, .a1 = 1}});
    const auto from = of({view::Ramp{.x0 = 0.25, .a0 = 0, .x1 = 0.5, .a1 = 0.5}});
    EXPECT_EQ(blend(from, to, 0.5).opacity_pins,
              (std::vector<view::OpacityPin>{view::Ramp{.x0 = 0.5, .a0 = 0.125, .x1 = 0.6875, .a1 = 0.75}}));
}

TEST(Blend, ColoursMixAtEveryValue) {
    for (const double share : {0.1, 0.5, 0.8}) {
        const auto made = blend(ramp, hats, share);
        for (int i = 0; i <= 200; ++i) {
            const double s = i / 200.0;
            const view::Rgb a = ramp.colour(s), b = hats.colour(s), c = made.colour(s);
            EXPECT_NEAR(c.r, a.r + share * (b.r - a.r), 1e-12) << s;
            EXPECT_NEAR(c.g, a.g + share * (b.g - a.g), 1e-12) << s;
            EXPECT_NEAR(c.b, a.b + share * (b.b - a.b), 1e-12) << s;
        }
    }
}

// However they differ, what comes of it is a transfer function, and nowhere more opaque than both.
TEST(Blend, OthersFade) {
    double before = 0;
    for (int i = 1; i < 20; ++i) {
        const double share = i / 20.0;
        const auto made = blend(ramp, hats, share);
        ASSERT_TRUE(view::validate(made));
        for (int j = 0; j <= 100; ++j) {
            const double s = j / 100.0;
            EXPECT_LE(made.opacity(s), std::max(ramp.opacity(s), hats.opacity(s)) + 1e-12);
        }
        EXPECT_GE(made.opacity(0.3), before) << "the hat grows";
        before = made.opacity(0.3);
    }
    EXPECT_GT(before, 0.7);
    EXPECT_GT(blend(ramp, hats, 0.49).opacity(0.8), 0);
    EXPECT_EQ(blend(ramp, hats, 0.51).opacity(0.8), 0) << "the blank is there";
}

TEST(Blend, StaysWithinTheBoundsOfPins) {
    std::vector<view::OpacityPin> many(200, view::Flat{.height = 0.1});
    std::vector<view::OpacityPin> others(200, view::Ramp{});
    for (const double share : {0.2, 0.7}) {
        EXPECT_TRUE(view::validate(blend(of(many), of(others), share)));
    }
}

}  // namespace
}  // namespace shearwater::flight
