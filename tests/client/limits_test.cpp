#include "client/model/limits.h"

#include <gtest/gtest.h>

namespace shearwater::model {
namespace {

Cube cube_of_ramp() {
    volume::Histogram histogram;
    for (int i = 0; i <= 1000; ++i) {
        histogram.add(static_cast<float>(i));
    }
    Cube cube;
    cube.mapping = {.lo = 0, .hi = 500, .stretch = volume::Stretch::sqrt};
    cube.values = std::make_shared<const volume::Summary>(volume::summarise(histogram, cube.mapping));
    return cube;
}

TEST(Limits, AreFoundInTheCubesValues) {
    const Cube cube = cube_of_ramp();
    const auto at = [&](LimitsBy by) { return *scaling_by(by, cube); };
    EXPECT_EQ(at(LimitsBy::all), (volume::Scaling{0, 1000, volume::Stretch::sqrt}));
    EXPECT_NEAR(at(LimitsBy::p95).lo, 25, 2);
    EXPECT_NEAR(at(LimitsBy::p95).hi, 975, 2);
    EXPECT_NEAR(at(LimitsBy::p99).lo, 5, 2);
    EXPECT_NEAR(at(LimitsBy::p999).hi, 999.5, 1);
    EXPECT_LE(at(LimitsBy::zscale).lo, at(LimitsBy::p99).lo);
    Cube unknown = cube;
    unknown.values = nullptr;
    EXPECT_FALSE(scaling_by(LimitsBy::p99, unknown));
}

TEST(Limits, AreChecked) {
    EXPECT_TRUE(validate(volume::Scaling{1, 2}));
    for (const auto& [lo, hi] : {std::pair{2.0, 2.0}, {3.0, 2.0}, {std::nan(""), 1.0}, {0.0, HUGE_VAL}}) {
        EXPECT_FALSE(validate(volume::Scaling{lo, hi}));
    }
}

// s = sqrt(v / 500) before, (v - 100) / 800 after.
TEST(Limits, PinsCanBeHeldAtTheirValues) {
    const Cube cube = cube_of_ramp();
    const view::TransferFunction tf{.opacity_pins = {view::Ramp{0.5, 0, 1, 0.4}, view::Flat{0.1}},
                                    .colour_pins = view::default_transfer_function().colour_pins};
    const auto held_there = held(tf, cube, {100, 900, volume::Stretch::linear});
    const auto& ramp = std::get<view::Ramp>(held_there.opacity_pins[0]);
    EXPECT_NEAR(ramp.x0, (125.0 - 100) / 800, 1e-9);
    EXPECT_NEAR(ramp.x1, (500.0 - 100) / 800, 1e-9);
    EXPECT_EQ(ramp.a1, 0.4);
    EXPECT_EQ(held_there.opacity_pins[1], tf.opacity_pins[1]);
    const Cube same = [&] {
        Cube after = cube;
        after.mapping = {.lo = 100, .hi = 900};
        return after;
    }();
    const auto back = held(held_there, same, cube.mapping.scaling());
    EXPECT_NEAR(std::get<view::Ramp>(back.opacity_pins[0]).x0, 0.5, 1e-9);
}

}  // namespace
}  // namespace shearwater::model
