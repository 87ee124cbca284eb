// Colours, axes and anchoring: what the editor of transfer functions is made of besides pins.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "client/model/anchoring.h"
#include "client/model/colours.h"
#include "client/model/pins.h"
#include "client/model/plot_axes.h"

namespace shearwater::model {
namespace {

using namespace std::chrono_literals;

TEST(Colours, PinsAreAddedWhereTheyChangeNothing) {
    view::TransferFunction tf = view::default_transfer_function();
    const view::TransferFunction before = tf;
    const auto pin = add_colour(tf, 0.412);
    ASSERT_TRUE(pin);
    EXPECT_EQ(tf.colour_pins[*pin].at, 0.412);
    for (double s = 0; s <= 1; s += 0.01) {
        EXPECT_NEAR(tf.colour(s).g, before.colour(s).g, 1e-12);
    }
    EXPECT_EQ(view::colour_map_name(tf.colour_pins), "");
    while (tf.colour_pins.size() < view::TransferFunction::max_pins) {
        ASSERT_TRUE(add_colour(tf, 0.5));
    }
    EXPECT_FALSE(add_colour(tf, 0.5));
    EXPECT_TRUE(view::validate(tf));
}

TEST(Colours, PinsMoveAsFarAsTheirNeighboursAndTheLastOneStays) {
    view::TransferFunction tf = view::default_transfer_function();
    tf.colour_pins = {{0, {0, 0, 0}}, {0.5, {1, 0, 0}}, {1, {1, 1, 1}}};
    move_colour(tf, 1, 0.7);
    EXPECT_EQ(tf.colour_pins[1].at, 0.7);
    move_colour(tf, 1, 3);
    EXPECT_EQ(tf.colour_pins[1].at, 1);
    move_colour(tf, 1, std::nan(""));
    move_colour(tf, 9, 0.1);
    set_colour(tf, 0, {2, 0.25, -1});
    EXPECT_EQ(tf.colour_pins[0].rgb, (view::Rgb{1, 0.25, 0}));
    EXPECT_TRUE(view::validate(tf));
    remove_colour(tf, 7);
    remove_colour(tf, 1);
    remove_colour(tf, 0);
    remove_colour(tf, 0);
    ASSERT_EQ(tf.colour_pins.size(), 1U);
    EXPECT_EQ(tf.colour_pins[0].rgb, (view::Rgb{1, 1, 1}));
}

TEST(Colours, MapsAreChosenSteppedThroughAndReversed) {
    view::TransferFunction tf = view::default_transfer_function();
    const auto names = view::colour_map_names();
    choose_map(tf, names.front());
    for (std::size_t i = 1; i <= names.size(); ++i) {
        step_map(tf, 1);
        EXPECT_EQ(view::colour_map_name(tf.colour_pins), names[i % names.size()]);
    }
    step_map(tf, -1);
    EXPECT_EQ(view::colour_map_name(tf.colour_pins), names.back());
    reverse_colours(tf);
    EXPECT_EQ(view::colour_map_name(tf.colour_pins), names.back() + "-r");
    step_map(tf, 1);
    EXPECT_EQ(view::colour_map_name(tf.colour_pins), names.front() + "-r");
    choose_map(tf, "no such map");
    EXPECT_EQ(view::colour_map_name(tf.colour_pins), names.front() + "-r");
    tf.colour_pins = {{0.25, {0, 0, 1}}, {1, {1, 0, 0}}};
    reverse_colours(tf);
    EXPECT_EQ(tf.colour_pins, (std::vector<view::ColourPin>{{0, {1, 0, 0}}, {0.75, {0, 0, 1}}}));
    step_map(tf, 1);
    EXPECT_EQ(view::colour_map_name(tf.colour_pins), names.front()) << "instead of own pins";
    tf.colour_pins = {{0.25, {0, 0, 1}}};
    step_map(tf, -1);
    EXPECT_EQ(view::colour_map_name(tf.colour_pins), names.back());
}

TEST(OpacityAxes, RiseFromBottomToTopAndBack) {
    for (const OpacityAxis axis : {OpacityAxis::cube_root, OpacityAxis::logarithmic, OpacityAxis::linear}) {
        EXPECT_EQ(height_share(axis, 0), 0);
        EXPECT_EQ(height_share(axis, 1), 1);
        EXPECT_EQ(opacity_at(axis, 0), 0);
        EXPECT_EQ(opacity_at(axis, 1), 1);
        EXPECT_EQ(opacity_at(axis, -3), 0);
        EXPECT_EQ(opacity_at(axis, 3), 1);
        double last = 0;
        for (double a = 2e-5; a < 1; a *= 1.3) {
            EXPECT_GT(height_share(axis, a), last);
            last = height_share(axis, a);
            EXPECT_NEAR(opacity_at(axis, last), a, 1e-12);
        }
        for (const double mark : opacity_marks(axis)) {
            EXPECT_GT(height_share(axis, mark), 0.05);
        }
    }
    EXPECT_NEAR(height_share(OpacityAxis::logarithmic, 0.01), 0.6, 1e-12);
    EXPECT_NEAR(height_share(OpacityAxis::cube_root, 0.001), 0.1, 1e-12);
}

Cube cube_of(double mean, double sigma, const volume::Mapping& mapping) {
    std::mt19937 random(5);
    std::normal_distribution<float> draw(static_cast<float>(mean), static_cast<float>(sigma));
    volume::Histogram histogram;
    for (int i = 0; i < 20000; ++i) {
        histogram.add(draw(random));
    }
    return {.name = "cube",
            .lattice = {},
            .mapping = mapping,
            .values = std::make_shared<const volume::Summary>(volume::summarise(histogram, mapping))};
}

TEST(Ticks, AreRoundInEveryUnit) {
    const Cube cube = cube_of(1, 0.5, {.lo = -0.5, .hi = 2.5, .stretch = volume::Stretch::sqrt});
    const view::ValueScale scale = cube.scale();
    for (const view::Unit unit :
         {view::Unit::stretched, view::Unit::value, view::Unit::percentile, view::Unit::sigma}) {
        const std::vector<Tick> marks = ticks(scale, unit, 6);
        EXPECT_GE(marks.size(), 4U);
        EXPECT_LE(marks.size(), 20U);
        double last = -1;
        for (const Tick& mark : marks) {
            EXPECT_GT(mark.s, last);
            last = mark.s;
            EXPECT_LE(mark.s, 1);
            EXPECT_LE(mark.label.size(), 6U) << mark.label;
            EXPECT_NEAR(scale.from_s(unit, mark.s), std::stod(mark.label), 1e-6) << mark.label;
        }
    }
    const auto by_value = ticks(scale, view::Unit::value, 6);
    EXPECT_EQ(by_value.front().label, "-0.5");
    EXPECT_EQ(by_value[1].label, "0");
    const auto by_sigma = ticks(scale, view::Unit::sigma, 6);
    EXPECT_EQ(by_sigma.front().label, "-2") << "limits at about -3 and 3 sigma, steps of 2";
}

TEST(Ticks, OfHostileScalesAreFew) {
    for (const auto& [lo, hi] :
         {std::pair{0.0, 0.0}, {-1e308, 1e307}, {1e300, 1.0000001e300}, {0.0, 5e-324}}) {
        const view::ValueScale scale({.lo = lo, .hi = hi});
        EXPECT_LE(ticks(scale, view::Unit::value, 6).size(), 20U);
    }
}

TEST(Snapping, TakesTheNearestWithinReach) {
    view::TransferFunction tf = view::default_transfer_function();
    tf.opacity_pins = {view::Ramp{0.21, 0, 0.9, 1}, view::Hat{0.5, 0.1, 0.2, 1}, view::Blank{0.33, 0.34}};
    const std::vector<Tick> marks{{0.25, "a"}, {0.5, "b"}};
    const auto targets = snap_targets(tf, 2, marks);
    EXPECT_EQ(targets.size(), 2U + 4 + 2);
    EXPECT_EQ(snapped(0.22, targets, 0.02), 0.21);
    EXPECT_EQ(snapped(0.24, targets, 0.02), 0.25);
    EXPECT_EQ(snapped(0.3, targets, 0.02), 0.3);
    EXPECT_NEAR(snapped(0.41, targets, 0.02), 0.4, 1e-12);
    EXPECT_EQ(snapped(0.335, targets, 0.004), 0.335) << "not to its own edges";
}

class AnchoringTest : public testing::Test {
  protected:
    Status status_;
    view::TransferFunction shown_ = view::default_transfer_function();
    wire::Time now_{};

    static view::AnchoredFunction by(view::Unit unit) {
        view::AnchoredFunction function{.tf = view::default_transfer_function(), .unit = unit};
        function.own_colours = false;
        function.tf.opacity_pins = {view::Ramp{1, 0, 3, 0.5}};
        return function;
    }
};

TEST_F(AnchoringTest, WhatIsInStretchedValuesWaitsForNothing) {
    Anchoring anchoring(by(view::Unit::stretched));
    EXPECT_EQ(anchoring.settle(status_, shown_, now_), by(view::Unit::stretched).tf);
    EXPECT_FALSE(anchoring.pending());
    EXPECT_FALSE(anchoring.settle(status_, shown_, now_));
}

TEST_F(AnchoringTest, IsPutOntoTheSketchFirstAndThenOntoTheCube) {
    Anchoring anchoring(by(view::Unit::sigma));
    EXPECT_FALSE(anchoring.settle(status_, shown_, now_));
    status_.cube = cube_of(0, 1, {.lo = -4, .hi = 4});
    status_.cube->provisional = status_.cube->provisional_values = true;
    const auto first = anchoring.settle(status_, shown_, now_);
    ASSERT_TRUE(first);
    EXPECT_NEAR(std::get<view::Ramp>(first->opacity_pins[0]).x0, 5.0 / 8, 0.02);
    EXPECT_TRUE(anchoring.pending());
    EXPECT_FALSE(anchoring.settle(status_, *first, now_));
    status_.cube = cube_of(0, 2, {.lo = -4, .hi = 4});
    const auto second = anchoring.settle(status_, *first, now_);
    ASSERT_TRUE(second);
    EXPECT_NEAR(std::get<view::Ramp>(second->opacity_pins[0]).x0, 6.0 / 8, 0.02);
    EXPECT_FALSE(anchoring.pending());
}

TEST_F(AnchoringTest, LeavesAloneWhatThePersonHasChangedMeanwhile) {
    Anchoring anchoring(by(view::Unit::value));
    status_.cube = cube_of(0, 1, {.lo = -4, .hi = 4});
    status_.cube->provisional = true;
    auto first = anchoring.settle(status_, shown_, now_);
    ASSERT_TRUE(first);
    first->opacity_pins.push_back(view::Flat{0.1});
    status_.cube = cube_of(0, 1, {.lo = -8, .hi = 8});
    EXPECT_FALSE(anchoring.settle(status_, *first, now_));
    EXPECT_FALSE(anchoring.pending());
    EXPECT_EQ(anchoring.fault(), "");
}

TEST_F(AnchoringTest, SaysWhyItCannotBeUsed) {
    Anchoring constant(by(view::Unit::sigma));
    status_.cube = cube_of(3, 0, {.lo = 0, .hi = 4});
    EXPECT_FALSE(constant.settle(status_, shown_, now_));
    EXPECT_FALSE(constant.pending());
    EXPECT_NE(constant.fault().find("sigma"), std::string::npos);

    // A server that never tells.
    Anchoring waiting(by(view::Unit::percentile));
    status_.cube->values = nullptr;
    status_.tree.ready = true;
    EXPECT_FALSE(waiting.settle(status_, shown_, now_));
    EXPECT_FALSE(waiting.settle(status_, shown_, now_ + 19s));
    EXPECT_TRUE(waiting.pending());
    EXPECT_FALSE(waiting.settle(status_, shown_, now_ + 21s));
    EXPECT_FALSE(waiting.pending());
    EXPECT_NE(waiting.fault().find("histogram"), std::string::npos);
}

}  // namespace
}  // namespace shearwater::model
