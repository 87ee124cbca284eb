// Values between the nodes of a grid, and grids that keep to formulas.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/wcs/sample.h"

namespace shearwater::wcs {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Axis axis(std::array<int, 3> nodes, std::vector<double> values, bool circle = false) {
    return {
        .name = "a", .label = "a", .unit = "", .circle = circle, .nodes = nodes, .values = std::move(values)};
}

TEST(AxisValue, IsLinearBetweenTwoNodes) {
    const Axis a = axis({2, 1, 1}, {10, 30});
    for (const auto& [voxel, value] :
         {std::pair(0.0, 10.0), {5, 20}, {7.5, 25}, {10, 30}, {11, 32}, {-0.5, 9}}) {
        EXPECT_DOUBLE_EQ(value_at(a, {11, 7, 5}, {voxel, 3, 2}), value);
    }
    EXPECT_TRUE(rises(a, 0, {11, 7, 5}));
    EXPECT_FALSE(rises(axis({2, 1, 1}, {30, 10}), 0, {11, 7, 5}));
}

TEST(AxisValue, IsMultilinearOnAGrid) {
    // 1 + 2x + 3y + xy at x = 0, 4, 8 and y = 0, 6.
    const Axis a = axis({3, 2, 1}, {1, 9, 17, 19, 51, 83});
    for (const auto& [x, y] : {std::pair(0.0, 0.0), {8, 6}, {3, 2}, {7.5, 1.25}, {4, 6}}) {
        EXPECT_NEAR(value_at(a, {9, 7, 5}, {x, y, 4}), 1 + 2 * x + 3 * y + x * y, 1e-12) << x << " " << y;
    }
}

TEST(AxisValue, OfACircleGoesTheShorterWay) {
    const Axis a = axis({2, 1, 1}, {350, 10}, true);
    EXPECT_NEAR(value_at(a, {5, 5, 5}, {1, 0, 0}), 355, 1e-12);
    EXPECT_NEAR(value_at(a, {5, 5, 5}, {3, 0, 0}), 5, 1e-12);
    EXPECT_NEAR(difference(a, 350, 10), 20, 1e-12);
    EXPECT_NEAR(difference(a, 10, 350), -20, 1e-12);
    EXPECT_TRUE(rises(a, 0, {5, 5, 5}));
}

TEST(AxisValue, IsNoneWhereThereIsNone) {
    EXPECT_TRUE(std::isnan(value_at(Axis{}, {5, 5, 5}, {1, 1, 1})));
    EXPECT_TRUE(std::isnan(value_at(axis({3, 1, 1}, {1, nan, 3}), {5, 5, 5}, {1, 0, 0})));
    EXPECT_DOUBLE_EQ(value_at(axis({3, 1, 1}, {1, 2, nan}), {5, 5, 5}, {2, 0, 0}), 2) << "a node by itself";
    // Around a pole: right ascensions all around.
    EXPECT_TRUE(std::isnan(value_at(axis({2, 2, 1}, {45, 315, 135, 225}, true), {5, 5, 5}, {2, 2, 0})));
    EXPECT_TRUE(std::isnan(value_at(axis({2, 1, 1}, {1, 2}), {5, 5, 5}, {nan, nan, nan})) ||
                value_at(axis({2, 1, 1}, {1, 2}), {5, 5, 5}, {nan, nan, nan}) == 1);
}

TEST(AxisValidation, Hostile) {
    EXPECT_TRUE(validate(Axis{}, 0));
    EXPECT_TRUE(validate(axis({2, 1, 1}, {1, nan}), 0));
    EXPECT_TRUE(validate(axis({33, 33, 1}, std::vector<double>(33 * 33, 1)), 1));
    EXPECT_TRUE(validate(voxel_axis(2, {9, 9, std::int64_t{1} << 40}), 2));
    EXPECT_FALSE(validate(axis({2, 1, 1}, {1, 2}), 1)) << "nothing changes along the axis";
    EXPECT_FALSE(validate(axis({2, 1, 1}, {1, 2, 3}), 0));
    EXPECT_FALSE(validate(axis({2, 0, 1}, {1, 2}), 0));
    EXPECT_FALSE(validate(axis({2, -1, -1}, {1, 2}), 0));
    EXPECT_FALSE(validate(axis({34, 1, 1}, std::vector<double>(34)), 0));
    EXPECT_FALSE(validate(axis({33, 33, 2}, std::vector<double>(33 * 33 * 2)), 0)) << "too many";
    EXPECT_FALSE(validate(axis({2, 1, 1}, {1, HUGE_VAL}), 0));
    EXPECT_FALSE(validate(axis({2, 1, 1}, {1, -1e101}), 0));
    EXPECT_FALSE(validate(axis({2, 1, 1}, {1, 721}, true), 0));
    Axis nameless = axis({2, 1, 1}, {1, 2});
    nameless.label.clear();
    EXPECT_FALSE(validate(nameless, 0));
}

// A formula of one place, applied to many.
Formula each(double (*one)(const Place&)) {
    return [one](std::span<const Place> places) {
        std::vector<double> values;
        for (const Place& place : places) {
            values.push_back(one(place));
        }
        return values;
    };
}

TEST(AxisSampling, TakesAsFewNodesAsWillDo) {
    Axis linear = axis({1, 1, 1}, {});
    ASSERT_TRUE(sample(linear, 1, {30, 40, 50}, each([](const Place& p) { return 5 - 2 * p[1]; })));
    EXPECT_EQ(linear.nodes, (std::array{1, 2, 1}));
    EXPECT_EQ(linear.values, (std::vector<double>{5, -73}));

    Axis sheared = axis({1, 1, 1}, {});
    ASSERT_TRUE(sample(sheared, 0, {30, 40, 50}, each([](const Place& p) { return p[0] + 0.5 * p[2]; })));
    EXPECT_EQ(sheared.nodes, (std::array{2, 1, 2}));

    Axis curved = axis({1, 1, 1}, {});
    ASSERT_TRUE(sample(curved, 0, {1000, 40, 50}, each([](const Place& p) { return std::exp(p[0] / 500); })));
    EXPECT_GT(curved.nodes[0], 4);
    EXPECT_TRUE(validate(curved, 0));
}

TEST(AxisSampling, KeepsToAFormulaWithinATenthOfAVoxel) {
    const auto formula = [](const Place& p) {
        return 350 + p[0] * 0.1 / std::cos(p[1] * 0.004) + p[0] * p[0] * 1e-5;
    };
    Axis a = axis({1, 1, 1}, {}, true);
    ASSERT_TRUE(sample(a, 0, {200, 150, 7}, each(formula)));
    EXPECT_TRUE(validate(a, 0));
    EXPECT_EQ(a.nodes[2], 1);
    for (double x = 0; x < 199.5; x += 7.3) {
        for (double y = 0; y < 149.5; y += 5.1) {
            EXPECT_NEAR(difference(a, formula({x, y, 3}), value_at(a, {200, 150, 7}, {x, y, 3})), 0, 0.01);
        }
    }
}

TEST(AxisSampling, GivesUpWhereThereIsNothing) {
    const Axis before = axis({1, 1, 1}, {});
    Axis a = before;
    EXPECT_FALSE(sample(a, 0, {9, 9, 9}, each([](const Place& p) { return p[1]; })));
    EXPECT_FALSE(sample(a, 0, {9, 9, 9}, each([](const Place&) { return nan; })));
    EXPECT_FALSE(sample(a, 0, {9, 9, 9}, each([](const Place& p) { return 1e300 * (1 + p[0]); })));
    EXPECT_EQ(a, before);
    // Half of it is out of reach.
    ASSERT_TRUE(sample(a, 0, {65, 9, 9}, each([](const Place& p) { return p[0] < 30 ? p[0] : nan; })));
    EXPECT_DOUBLE_EQ(value_at(a, {65, 9, 9}, {20, 4, 4}), 20);
    EXPECT_TRUE(std::isnan(value_at(a, {65, 9, 9}, {50, 4, 4})));
}

}  // namespace
}  // namespace shearwater::wcs
