#include "common/volume/histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <random>

#include "tests/support/simd_targets.h"

namespace shearwater::volume {
namespace {

constexpr float endless = std::numeric_limits<float>::infinity();
constexpr float largest = std::numeric_limits<float>::max();

Histogram of(std::span<const float> values) {
    Histogram histogram;
    histogram.add(values);
    return histogram;
}

void expect_same_counts(const Histogram& a, const Histogram& b) {
    EXPECT_EQ(a.filled(), b.filled());
    EXPECT_EQ(a.valid(), b.valid());
    EXPECT_EQ(a.blank(), b.blank());
    EXPECT_EQ(a.min(), b.min());
    EXPECT_EQ(a.max(), b.max());
}

std::vector<float> normal(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> distribution(0.5F, 2.0F);
    std::vector<float> values(count);
    std::generate(values.begin(), values.end(), [&] { return distribution(random); });
    return values;
}

TEST(Histogram, KeysRiseWithValuesAndEdgesHoldThem) {
    std::mt19937 random(3);
    std::vector<float> values = {-largest, -1, -1e-45F, 0, 1e-45F, 1, 4095, largest, -4095};
    for (int i = 0; i < 20000; ++i) {
        const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        if (std::isfinite(value)) {
            values.push_back(value);
        }
    }
    std::sort(values.begin(), values.end());
    std::uint32_t last = 0;
    for (const float value : values) {
        const std::uint32_t key = Histogram::key_of(value);
        EXPECT_GE(key, last);
        EXPECT_LE(Histogram::lower_edge(key), value);
        EXPECT_GT(Histogram::lower_edge(key + 1), value);
        last = key;
    }
}

TEST(Histogram, BothZerosShareABin) {
    EXPECT_EQ(Histogram::key_of(-0.0F), Histogram::key_of(0.0F));
    Histogram histogram;
    histogram.add(-0.0F);
    EXPECT_FALSE(std::signbit(histogram.min()));
}

TEST(Histogram, SmallIntegersHaveABinEach) {
    for (int i = -4095; i < 4095; ++i) {
        EXPECT_LT(Histogram::key_of(static_cast<float>(i)), Histogram::key_of(static_cast<float>(i + 1)));
    }
}

TEST(Histogram, AnyDivisionAddsUpToTheWhole) {
    std::vector<float> values = normal(100000, 1);
    values[5] = endless;
    values[77] = std::nanf("");
    values[99] = 1e38F;
    values[100] = -1e38F;
    const Histogram expected = of(values);
    std::mt19937 random(2);
    for (int division = 0; division < 5; ++division) {
        std::shuffle(values.begin(), values.end(), random);
        Histogram live;
        Histogram through_bins;
        for (std::size_t first = 0; first < values.size();) {
            const std::size_t count = std::min<std::size_t>(random() % 30000, values.size() - first);
            const Histogram part = of(std::span(values).subspan(first, count));
            live.merge(part);
            EXPECT_TRUE(through_bins.merge(part.filled(), part.blank(), part.min(), part.max()));
            first += count;
        }
        expect_same_counts(live, expected);
        expect_same_counts(through_bins, expected);
    }
}

// Values of every size and both signs, one in nine blank, against counting them one by one.
TEST(Histogram, EveryTargetCountsEachValueInItsBin) {
    std::mt19937 random(6);
    std::vector<float> all(3000);
    for (float& value : all) {
        value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        value = random() % 9 == 0 ? std::nanf("") : random() % 9 == 0 ? -0.0F : value;
    }
    support::for_each_target([&] {
        for (std::size_t count = 0; count < 2000; count += count < 70 ? 1 : 411) {
            const std::span<const float> values = std::span(all).subspan(count % 7, count);
            std::map<std::uint32_t, std::uint64_t> bins;
            std::uint64_t blank = 0;
            float least = endless;
            float most = -endless;
            for (const float value : values) {
                if (!std::isfinite(value)) {
                    ++blank;
                    continue;
                }
                ++bins[Histogram::key_of(value)];
                least = std::min(least, value);
                most = std::max(most, value);
            }
            const Histogram histogram = of(values);
            EXPECT_EQ(histogram.blank(), blank);
            EXPECT_EQ(histogram.valid(), count - blank);
            EXPECT_EQ(histogram.min(), bins.empty() ? 0 : least);
            EXPECT_EQ(histogram.max(), bins.empty() ? 0 : most);
            std::vector<Histogram::Bin> expected;
            for (const auto& [key, times] : bins) {
                expected.push_back({key, times});
            }
            ASSERT_EQ(histogram.filled(), expected) << count;
        }
    });
}

TEST(Histogram, QuantilesFollowSortedData) {
    std::vector<float> values = normal(50001, 9);
    const Histogram histogram = of(values);
    std::sort(values.begin(), values.end());
    for (const double fraction : {0.0, 0.0025, 0.1, 0.25, 0.5, 0.77, 0.9975, 1.0}) {
        const double exact = values[static_cast<std::size_t>(fraction * 50000)];
        EXPECT_NEAR(histogram.quantile(fraction), exact, std::abs(exact) / 1024 + 1e-3) << fraction;
    }
    EXPECT_EQ(histogram.quantile(0), values.front());
    EXPECT_EQ(histogram.quantile(1), values.back());
}

TEST(Histogram, PercentilesCutEitherEndAlike) {
    std::vector<float> values(2001);
    std::iota(values.begin(), values.end(), -1000.0F);
    const Limits limits = percentile_limits(of(values), 99.5);
    EXPECT_NEAR(limits.lo, -995, 1.1);
    EXPECT_NEAR(limits.hi, 995, 1.1);
    const Limits all = percentile_limits(of(values), 100);
    EXPECT_EQ(all.lo, -1000);
    EXPECT_EQ(all.hi, 1000);
}

TEST(Histogram, OutliersDoNotSpoilTheRest) {
    std::vector<float> values = normal(100000, 4);
    const Limits clean = percentile_limits(of(values), 99);
    values.insert(values.end(), {1e38F, -1e38F, 3e38F});
    const Limits spoilt = percentile_limits(of(values), 99);
    EXPECT_NEAR(spoilt.lo, clean.lo, 0.01);
    EXPECT_NEAR(spoilt.hi, clean.hi, 0.01);
}

TEST(Histogram, DenormalAndTinyValuesKeepTheirSizes) {
    const std::vector<float> values = {8e-16F, 1e-40F, 5.67e-5F, 1e-20F, 1e-10F};
    const Histogram histogram = of(values);
    EXPECT_EQ(histogram.filled().size(), 5U);
    EXPECT_NEAR(histogram.quantile(0.6) / 8e-16, 1, 1e-3);
}

TEST(Histogram, ZerosHaveZeroForTheirQuantiles) {
    std::vector<float> values(100, 0.0F);
    values.insert(values.end(), 50, 7.0F);
    const Histogram histogram = of(values);
    EXPECT_EQ(histogram.quantile(0.1), 0);
    EXPECT_EQ(histogram.quantile(0.5), 0);
    EXPECT_NEAR(histogram.quantile(0.9), 7, 7.0 / 2048);
}

TEST(Histogram, AllBlankHasNoValues) {
    const Histogram histogram = of(std::vector<float>{std::nanf(""), endless, -endless});
    EXPECT_EQ(histogram.valid(), 0U);
    EXPECT_EQ(histogram.blank(), 3U);
    EXPECT_EQ(histogram.quantile(0.5), 0);
    const Limits limits = percentile_limits(histogram, 99.5);
    EXPECT_EQ(limits.lo, 0);
    EXPECT_EQ(limits.hi, 1);
    Histogram other;
    EXPECT_TRUE(other.merge(histogram.filled(), histogram.blank(), histogram.min(), histogram.max()));
    expect_same_counts(other, histogram);
}

TEST(Histogram, ConstantDataGivesTheConstant) {
    const Histogram histogram = of(std::vector<float>(1000, -0.3F));
    const Limits limits = percentile_limits(histogram, 99.5);
    EXPECT_EQ(limits.lo, double{-0.3F});
    EXPECT_EQ(limits.hi, double{-0.3F});
}

TEST(Histogram, RefusesBinsThatContradictThemselves) {
    const std::uint32_t one = Histogram::key_of(1);
    const std::uint32_t two = Histogram::key_of(2);
    Histogram histogram = of(std::vector<float>{7, endless});
    const Histogram before = histogram;
    using Bins = std::vector<Histogram::Bin>;
    constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    const double nan = std::nan("");
    EXPECT_FALSE(histogram.merge(Bins{{two, 1}, {one, 1}}, 0, 1, 2));
    EXPECT_FALSE(histogram.merge(Bins{{one, 1}, {one, 1}}, 0, 1, 1));
    EXPECT_FALSE(histogram.merge(Bins{{Histogram::bins, 1}}, 0, 1, 1));
    EXPECT_FALSE(histogram.merge(Bins{{Histogram::bins - 1, 1}}, 0, 1, 1));
    EXPECT_FALSE(histogram.merge(Bins{{0, 1}}, 0, 1, 1));
    EXPECT_FALSE(histogram.merge(Bins{{one, 0}}, 0, 1, 1));
    EXPECT_FALSE(histogram.merge(Bins{{one, most}}, 0, 1, 1));
    EXPECT_FALSE(histogram.merge(Bins{{one, most / 2}, {two, most / 2 + 1}}, 0, 1, 2));
    EXPECT_FALSE(histogram.merge(Bins{{one, 1}}, most, 1, 1));
    EXPECT_FALSE(histogram.merge(Bins{{one, 1}, {two, 1}}, 0, 1, 3));
    EXPECT_FALSE(histogram.merge(Bins{{one, 1}, {two, 1}}, 0, 0.5, 2));
    EXPECT_FALSE(histogram.merge(Bins{{one, 1}}, 0, nan, 1));
    EXPECT_FALSE(histogram.merge(Bins{{one, 1}}, 0, 1, endless));
    EXPECT_FALSE(histogram.merge(Bins{{one, 1}}, 0, -1e300, 1));
    expect_same_counts(histogram, before);
    EXPECT_TRUE(histogram.merge(Bins{{one, 3}, {two, 1}}, 2, 1, 2));
    EXPECT_EQ(histogram.valid(), 5U);
    EXPECT_EQ(histogram.blank(), 3U);
    EXPECT_EQ(histogram.min(), 1);
    EXPECT_EQ(histogram.max(), 7);
}

}  // namespace
}  // namespace shearwater::volume
