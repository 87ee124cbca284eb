#include "common/volume/zscale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace shearwater::volume {
namespace {

Summary summary_of(const std::vector<float>& values) {
    Histogram histogram;
    histogram.add(values);
    return summarise(histogram, {.lo = 0, .hi = 1});
}

// Values on one line are the line: steepened, it leaves the cube's values at once.
TEST(Zscale, OfALineAreItsEnds) {
    std::vector<float> values(10000);
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = static_cast<float>(i) * 0.01F - 20;
    }
    const Limits limits = zscale_limits(summary_of(values));
    EXPECT_NEAR(limits.lo, -20, 0.01);
    EXPECT_NEAR(limits.hi, 79.99, 0.01);
    // Of half the slope a quarter on either side of the middle.
    const Limits shallow = zscale_limits(summary_of(values), 2);
    EXPECT_NEAR(shallow.lo, 30 - 25, 0.3);
    EXPECT_NEAR(shallow.hi, 30 + 25, 0.3);
}

// Noise with a few bright sources: the limits are the noise's.
TEST(Zscale, SourcesDoNotMoveThem) {
    std::mt19937 random(7);
    std::normal_distribution<float> noise(3, 0.5F);
    std::vector<float> values(200000);
    for (float& value : values) {
        value = noise(random);
    }
    const Limits alone = zscale_limits(summary_of(values));
    for (std::size_t i = 0; i < values.size(); i += 100) {
        values[i] = 1000.0F + static_cast<float>(i);
    }
    const Limits among = zscale_limits(summary_of(values));
    EXPECT_NEAR(among.lo, alone.lo, 0.1);
    EXPECT_NEAR(among.hi, alone.hi, 1.0);
    EXPECT_GT(among.hi, 3 + 2 * 0.5);
    EXPECT_LT(among.hi, 3 + 10 * 0.5);
    EXPECT_LT(among.lo, 3 - 2 * 0.5);
}

TEST(Zscale, OfFewValues) {
    for (const std::vector<float>& values : {std::vector<float>{5}, {5, 5, 5}, {-1, 2}, {0, 0, 0, 0, 9}}) {
        const Summary summary = summary_of(values);
        const Limits limits = zscale_limits(summary);
        EXPECT_LE(limits.lo, limits.hi);
        EXPECT_GE(limits.lo, summary.min);
        EXPECT_LE(limits.hi, summary.max);
    }
}

}  // namespace
}  // namespace shearwater::volume
