#include "common/view/anchored_function.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace shearwater::view {
namespace {

using volume::Mapping;
using volume::Stretch;

std::shared_ptr<const volume::Summary> noise(double mean, double sigma, const Mapping& mapping) {
    std::mt19937 random(5);
    std::normal_distribution<float> draw(static_cast<float>(mean), static_cast<float>(sigma));
    volume::Histogram histogram;
    for (int i = 0; i < 50000; ++i) {
        histogram.add(draw(random));
    }
    return std::make_shared<const volume::Summary>(volume::summarise(histogram, mapping));
}

ValueScale scale_of(double mean, double sigma, const Mapping& mapping) {
    return ValueScale(mapping, noise(mean, sigma, mapping));
}

constexpr Unit units[] = {Unit::stretched, Unit::value, Unit::percentile, Unit::sigma};
constexpr Stretch stretches[] = {Stretch::linear, Stretch::sqrt, Stretch::log, Stretch::asinh};

TEST(ValueScale, ByFormula) {
    const ValueScale scale = scale_of(10, 2, {.lo = 4, .hi = 20});
    EXPECT_DOUBLE_EQ(scale.from_s(Unit::value, 0.25), 8);
    EXPECT_DOUBLE_EQ(scale.to_s(Unit::value, 12), 0.5);
    EXPECT_NEAR(scale.from_s(Unit::sigma, 0.375), 0, 0.02);
    EXPECT_NEAR(scale.to_s(Unit::sigma, 3), (16.0 - 4) / 16, 0.01);
    EXPECT_NEAR(scale.to_s(Unit::percentile, 50), 0.375, 0.002);
    EXPECT_NEAR(scale.from_s(Unit::percentile, 0.5), 84.13, 0.5);
    const ValueScale log({.lo = 0, .hi = 1, .stretch = Stretch::log});
    EXPECT_NEAR(log.to_s(Unit::value, 99.0 / 999), 2.0 / 3, 1e-12);
}

TEST(ValueScale, ThereAndBackForEveryStretchAndUnitEvenBeyondTheLimits) {
    for (const Stretch stretch : stretches) {
        const ValueScale scale = scale_of(1, 0.5, {.lo = -0.5, .hi = 2.5, .stretch = stretch});
        for (const Unit unit : units) {
            double last = -std::numeric_limits<double>::infinity();
            for (double s = -0.4; s < 1.5; s += 0.01) {
                const double there = scale.from_s(unit, s);
                EXPECT_GT(there, last);
                last = there;
                EXPECT_NEAR(scale.to_s(unit, there), s, 1e-6) << name(unit) << " " << volume::name(stretch);
            }
        }
    }
}

TEST(ValueScale, IsFiniteFarOut) {
    for (const Stretch stretch : stretches) {
        const ValueScale scale = scale_of(0, 1, {.lo = -3, .hi = 3, .stretch = stretch});
        for (const Unit unit : units) {
            for (const double x : {-1e300, -1e6, 1e6, 1e300, 1e308}) {
                EXPECT_TRUE(std::isfinite(scale.from_s(unit, x)));
                EXPECT_LE(std::abs(scale.to_s(unit, x)), TransferFunction::farthest);
            }
        }
    }
}

TEST(ValueScale, SaysWhichUnitsMeanNothing) {
    const Mapping mapping{.lo = 0, .hi = 1};
    const ValueScale uncounted(mapping);
    EXPECT_TRUE(uncounted.has(Unit::stretched) && uncounted.has(Unit::value));
    EXPECT_THAT(uncounted.fault_of(Unit::percentile), testing::HasSubstr("histogram"));
    volume::Histogram constant;
    constant.add(3);
    const ValueScale flat(mapping,
                          std::make_shared<const volume::Summary>(volume::summarise(constant, mapping)));
    EXPECT_TRUE(flat.has(Unit::percentile));
    EXPECT_THAT(flat.fault_of(Unit::sigma), testing::HasSubstr("sigma"));
    const ValueScale blank(mapping, std::make_shared<const volume::Summary>());
    EXPECT_THAT(blank.fault_of(Unit::percentile), testing::HasSubstr("blank"));
    for (const Unit unit : units) {
        EXPECT_EQ(unit_named(name(unit)), unit);
    }
    EXPECT_FALSE(unit_named("furlong"));
}

TransferFunction example() {
    TransferFunction tf = default_transfer_function();
    tf.opacity_pins = {Ramp{0.3, 0.1, 0.9, 0.6}, Hat{0.5, 0.1, 0.3, 0.4, 0.05}, Flat{0.01}, Blank{0.2, 0.25}};
    tf.density = 2;
    return tf;
}

TEST(Anchored, OnItsOwnCubeIsWhatItWas) {
    for (const Stretch stretch : stretches) {
        const ValueScale scale = scale_of(1, 0.5, {.lo = -0.5, .hi = 2.5, .stretch = stretch});
        for (const Unit unit : units) {
            const TransferFunction tf = example();
            const auto back = on_scale(anchored(tf, unit, scale), &scale);
            ASSERT_TRUE(back) << back.error().message();
            for (double s = 0; s <= 1; s += 0.003) {
                EXPECT_NEAR(back->opacity(s), tf.opacity(s), 1e-5) << name(unit) << " at " << s;
            }
            EXPECT_EQ(back->colour_pins, tf.colour_pins);
            EXPECT_EQ(back->density, 2);
        }
    }
}

// The other cube is ten times as bright and differently stretched. At the same data value, percentile or
// sigma pins begin, bend and end; here where all of them do.
TEST(Anchored, MeansTheSameOnAnotherCube) {
    const Mapping one{.lo = -0.5, .hi = 2.5, .stretch = Stretch::linear};
    const Mapping ten{.lo = -2, .hi = 30, .stretch = Stretch::sqrt};
    const ValueScale here = scale_of(1, 0.5, one);
    const ValueScale there = scale_of(10, 5, ten);
    for (const Unit unit : {Unit::value, Unit::percentile, Unit::sigma}) {
        const TransferFunction tf = example();
        const auto moved = on_scale(anchored(tf, unit, here), &there);
        ASSERT_TRUE(moved) << moved.error().message();
        const auto same_place = [&](double s_here) { return there.to_s(unit, here.from_s(unit, s_here)); };
        const auto& ramp = std::get<Ramp>(moved->opacity_pins[0]);
        EXPECT_NEAR(ramp.x0, same_place(0.3), 1e-9);
        EXPECT_NEAR(ramp.x1, same_place(0.9), 1e-9);
        EXPECT_EQ(ramp.a1, 0.6);
        const auto& hat = std::get<Hat>(moved->opacity_pins[1]);
        EXPECT_NEAR(hat.centre - hat.base / 2, same_place(0.35), 1e-9);
        EXPECT_NEAR(hat.centre + hat.base / 2, same_place(0.65), 1e-9);
        EXPECT_NEAR(hat.centre + hat.lean - hat.top / 2, same_place(0.5), 1e-9);
        EXPECT_NEAR(hat.centre + hat.lean + hat.top / 2, same_place(0.6), 1e-9);
        EXPECT_NEAR(std::get<Blank>(moved->opacity_pins[3]).lo, same_place(0.2), 1e-9);
    }
    // A value means itself: the ramp's lower end of 0.4 lies at 0.4, whatever the cube.
    const auto by_value = on_scale(anchored(example(), Unit::value, here), &there).value();
    EXPECT_NEAR(ten.value_of_s(std::get<Ramp>(by_value.opacity_pins[0]).x0), 0.4, 1e-9);
}

TEST(Anchored, OwnColoursMoveAlongAndMapsSpanTheLimits) {
    const ValueScale here = scale_of(1, 0.5, {.lo = 0, .hi = 2});
    const ValueScale there = scale_of(1, 0.5, {.lo = 0, .hi = 4});
    TransferFunction tf = example();
    tf.colour_pins = {{0.1, {0, 0, 1}}, {0.8, {1, 0, 0}}};
    const AnchoredFunction own = anchored(tf, Unit::value, here);
    EXPECT_TRUE(own.own_colours);
    EXPECT_NEAR(on_scale(own, &there)->colour_pins[1].at, 0.4, 1e-12);
    // Two pins like a map's, but at data values, are no map.
    const auto read = transfer_function_from_toml(
        "[scale]\nunit = \"value\"\n[[colour]]\nat = 0\nrgb = [0, 0, 0]\n[[colour]]\nat = 1\nrgb = [255, "
        "255, 255]\n",
        "t");
    ASSERT_TRUE(read);
    EXPECT_NEAR(on_scale(*read, &there)->colour_pins[1].at, 0.25, 1e-12);
    EXPECT_EQ(transfer_function_from_toml(to_toml(*read), "t").value(), *read);
}

TEST(Anchored, IsWrittenAndReadBack) {
    const ValueScale scale = scale_of(1, 0.5, {.lo = -0.5, .hi = 2.5, .stretch = Stretch::asinh});
    for (const Unit unit : units) {
        const AnchoredFunction function = anchored(example(), unit, scale);
        const std::string text = to_toml(function);
        const auto back = transfer_function_from_toml(text, "t");
        ASSERT_TRUE(back) << back.error().message() << text;
        EXPECT_EQ(*back, function) << text;
    }
}

TEST(Anchored, WhatFallsTogetherIsAStep) {
    volume::Histogram zeros;
    zeros.add(std::vector<float>(100, 0.0F));
    zeros.add(1);
    const Mapping mapping{.lo = 0, .hi = 1};
    const ValueScale scale(mapping,
                           std::make_shared<const volume::Summary>(volume::summarise(zeros, mapping)));
    AnchoredFunction function{.tf = default_transfer_function(), .unit = Unit::percentile};
    function.own_colours = false;
    function.tf.opacity_pins = {Ramp{20, 0.2, 60, 0.8}, Hat{30, 10, 20, 0.5}};
    const auto tf = on_scale(function, &scale);
    ASSERT_TRUE(tf) << tf.error().message();
    EXPECT_NEAR(tf->opacity(0.01), 0.8, 1e-12);
    // What was no function before is none after.
    function.tf.opacity_pins = {Ramp{60, 0, 20, 1}};
    EXPECT_FALSE(on_scale(function, &scale));
    function.tf.opacity_pins = {Hat{30, 20, 10, 0.5}};
    EXPECT_FALSE(on_scale(function, &scale));
}

TEST(Anchored, HostileTextIsRefusedOrFitsTheCube) {
    const ValueScale scale = scale_of(1, 0.5, {.lo = -0.5, .hi = 2.5, .stretch = Stretch::log});
    std::mt19937 random(13);
    for (int round = 0; round < 3000; ++round) {
        std::string text = to_toml(anchored(example(), units[1 + random() % 3], scale));
        for (int edit = 0; edit < 3; ++edit) {
            text[random() % text.size()] = "0123456789.e+-\"=[]\n"[random() % 19];
        }
        if (const auto read = transfer_function_from_toml(text, "fuzz")) {
            const auto tf = on_scale(*read, &scale);
            EXPECT_TRUE(!tf || validate(*tf));
        }
    }
}

}  // namespace
}  // namespace shearwater::view
