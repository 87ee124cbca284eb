// Normal deviates against what is known of their distribution.

#include "common/synthetic/normal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/synthetic/hash.h"

namespace shearwater::synthetic {
namespace {

TEST(Normal, QuantilesAreThoseOfTheTables) {
    EXPECT_NEAR(normal_quantile(0.5), 0, 1e-9);
    EXPECT_NEAR(normal_quantile(0.15865525393145707), -1, 1e-9);
    EXPECT_NEAR(normal_quantile(0.0013498980316300946), -3, 1e-9);
    EXPECT_NEAR(normal_quantile(2.866515718791939e-7), -5, 1e-8);
    EXPECT_NEAR(normal_quantile(6.220960574271785e-16), -8, 1e-7);
}

TEST(Normal, IsMonotoneWithoutAStepBetweenCells) {
    const Normal normal;
    EXPECT_LT(normal(0), -8);
    float last = normal(std::uint64_t{1} << 48U);
    EXPECT_NEAR(last, -4.17, 0.01);  // one in 65536
    for (std::uint64_t i = 2; i < (1U << 16U); ++i) {
        const float x = normal(i << 48U);
        ASSERT_GE(x, last) << i;
        ASSERT_LT(x - last, i < 16 || i >= (1U << 16U) - 16 ? 0.2F : 0.03F) << i;
        last = x;
    }
    EXPECT_GT(normal(~std::uint64_t{0}), 8);
}

TEST(Normal, HasTheMomentsAndTailsOfTheDistribution) {
    const Normal normal;
    constexpr int count = 1 << 22;
    double sum = 0;
    double squares = 0;
    double fourths = 0;
    int above_three = 0;
    int below_four = 0;
    for (int i = 0; i < count; ++i) {
        const double x = normal(hash(i, 0, 0, 9));
        sum += x;
        squares += x * x;
        fourths += x * x * x * x;
        above_three += x > 3 ? 1 : 0;
        below_four += x < -4 ? 1 : 0;
    }
    EXPECT_NEAR(sum / count, 0, 0.003);
    EXPECT_NEAR(squares / count, 1, 0.004);
    EXPECT_NEAR(fourths / count, 3, 0.03);
    EXPECT_NEAR(above_three, 1.3499e-3 * count, 5 * std::sqrt(1.3499e-3 * count));
    EXPECT_NEAR(below_four, 3.167e-5 * count, 5 * std::sqrt(3.167e-5 * count));
}

}  // namespace
}  // namespace shearwater::synthetic
