#include "common/volume/summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "common/base/workers.h"
#include "common/volume/counting_source.h"
#include "common/volume/statistics.h"

namespace shearwater::volume {
namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

Histogram of(const std::vector<float>& values) {
    Histogram histogram;
    histogram.add(values);
    return histogram;
}

Histogram normal(double mean, double sigma, std::size_t count) {
    std::mt19937 random(3);
    std::normal_distribution<float> draw(static_cast<float>(mean), static_cast<float>(sigma));
    std::vector<float> values(count);
    for (float& value : values) {
        value = draw(random);
    }
    return of(values);
}

std::uint64_t sum(const Summary& summary) {
    return std::accumulate(summary.counts.begin(), summary.counts.end(), summary.below + summary.above);
}

TEST(Summary, CountsEveryValueOnce) {
    for (const Stretch stretch : {Stretch::linear, Stretch::sqrt, Stretch::log, Stretch::asinh}) {
        const Histogram histogram = normal(1, 2, 100000);
        const Summary summary = summarise(histogram, {.lo = -2, .hi = 5, .stretch = stretch});
        EXPECT_EQ(sum(summary), histogram.valid());
        EXPECT_EQ(summary.counts.size(), Summary::max_bins);
        EXPECT_TRUE(validate(summary));
        // 6.7 % lie more than 1.5 sigma below the mean, 2.3 % more than 2 above.
        EXPECT_NEAR(static_cast<double>(summary.below), 6681, 250);
        EXPECT_NEAR(static_cast<double>(summary.above), 2275, 150);
    }
}

// By formula: a bin's share of a uniform distribution is its width in values.
TEST(Summary, BinsAreEvenlySpacedInStretchedValues) {
    std::vector<float> values;
    for (int i = 0; i < 1 << 18; ++i) {
        values.push_back(static_cast<float>(i) / (1 << 18));
    }
    const Mapping mapping{.lo = 0, .hi = 1, .stretch = Stretch::sqrt};
    const Summary summary = summarise(of(values), mapping);
    const double bins = static_cast<double>(summary.counts.size());
    for (std::size_t i = 100; i < summary.counts.size(); i += 37) {
        const double from = static_cast<double>(i) / bins, to = static_cast<double>(i + 1) / bins;
        EXPECT_NEAR(static_cast<double>(summary.counts[i]), (to * to - from * from) * (1 << 18), 3) << i;
    }
}

TEST(Summary, MedianAndSigmaOfNoiseAreThatOfTheNoise) {
    const Summary summary = summarise(normal(-7, 0.5, 200000), {.lo = -8, .hi = -6});
    EXPECT_NEAR(summary.median, -7, 0.01);
    EXPECT_NEAR(summary.sigma, 0.5, 0.01);
    // A tenth of outliers hardly moves either.
    Histogram spoilt = normal(0, 1, 90000);
    spoilt.add(std::vector<float>(10000, 1e6F));
    const Summary robust = summarise(spoilt, {.lo = -3, .hi = 3});
    EXPECT_NEAR(robust.median, 0, 0.2);
    EXPECT_NEAR(robust.sigma, 1, 0.2);
}

TEST(Summary, QuantilesAreTheHistograms) {
    const Histogram histogram = normal(3, 1, 50000);
    const Summary summary = summarise(histogram, {.lo = 0, .hi = 6});
    ASSERT_EQ(summary.quantiles.size(), Summary::quantile_count);
    for (std::size_t i = 0; i < Summary::quantile_count; i += 10) {
        const double wanted = histogram.quantile(Summary::share_of(i));
        EXPECT_NEAR(summary.quantiles[i], wanted, std::abs(wanted) / 2048) << i << ": in the same bin";
    }
    for (const double share : {0.0, 1e-5, 0.0025, 0.1, 0.5, 0.75, 0.9975, 0.9999, 1.0}) {
        EXPECT_NEAR(summary.value_at(share), histogram.quantile(share), 0.03) << share;
    }
}

TEST(Summary, SharesAndValuesAreEachOthersInverse) {
    const Summary summary = summarise(normal(3, 1, 50000), {.lo = 0, .hi = 6});
    for (double share = -0.5; share < 1.5; share += 0.0137) {
        EXPECT_NEAR(summary.share_below(summary.value_at(share)), share, 1e-9);
    }
    for (const double share : {1e-9, 1e-7, 1e-4, 1 - 1e-4, 1 - 1e-7}) {
        EXPECT_NEAR(summary.share_below(summary.value_at(share)), share, 1e-12);
    }
    double last = -100;
    for (double value = -5; value < 12; value += 0.01) {
        EXPECT_GE(summary.share_below(value), last);
        last = summary.share_below(value);
    }
}

TEST(Summary, OfFewDifferentValuesHasFewBins) {
    std::vector<float> values;
    for (int i = 0; i < 256; ++i) {
        values.insert(values.end(), static_cast<std::size_t>(i + 1), static_cast<float>(i));
    }
    const Summary bytes = summarise(of(values), {.lo = 0, .hi = 255});
    EXPECT_EQ(bytes.counts.size(), 256U);
    EXPECT_EQ(sum(bytes), values.size());
    EXPECT_EQ(bytes.below + bytes.above, 0U) << "the limits themselves are within them";
    EXPECT_EQ(std::ranges::count(bytes.counts, 0U), 0);
    EXPECT_EQ(bytes.max, 255);

    const Summary two = summarise(of({0, 0, 0, 1}), {.lo = 0, .hi = 1});
    EXPECT_EQ(two.counts.front(), 3U);
    EXPECT_EQ(two.counts.back(), 1U);
    EXPECT_EQ(two.sigma, 0);
}

TEST(Summary, OfConstantAndBlankCubes) {
    const Summary constant = summarise(of({5, 5, 5, nan_value}), {.lo = 5, .hi = 5});
    EXPECT_TRUE(validate(constant));
    EXPECT_EQ(constant.blank, 1U);
    EXPECT_EQ(sum(constant), 3U);
    EXPECT_EQ(constant.median, 5);
    EXPECT_EQ(constant.sigma, 0);
    EXPECT_EQ(constant.value_at(0.3), 5);
    const Summary blank = summarise(of({nan_value, nan_value}), {.lo = 0, .hi = 1});
    EXPECT_TRUE(validate(blank));
    EXPECT_TRUE(blank.empty());
    EXPECT_EQ(blank.blank, 2U);
}

TEST(Summary, WhatContradictsItselfIsRefused) {
    const Summary good = summarise(normal(0, 1, 1000), {.lo = -3, .hi = 3});
    ASSERT_TRUE(validate(good));
    const auto refused = [&](const char* what, const auto& change) {
        Summary bad = good;
        change(bad);
        EXPECT_FALSE(validate(bad)) << what;
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    refused("bins", [](Summary& s) { s.counts.resize(513); });
    refused("no bins", [](Summary& s) { s.counts.clear(); });
    refused("quantiles", [](Summary& s) { s.quantiles.pop_back(); });
    refused("a quantile", [&](Summary& s) { s.quantiles[7] = nan; });
    refused("falling", [](Summary& s) { std::swap(s.quantiles[7], s.quantiles[8]); });
    refused("outside", [](Summary& s) { s.quantiles.back() = s.max + 1; });
    refused("median", [](Summary& s) { s.median = s.max + 1; });
    refused("no median", [&](Summary& s) { s.median = nan; });
    refused("sigma", [](Summary& s) { s.sigma = -1; });
    refused("infinite", [](Summary& s) { s.max = std::numeric_limits<double>::infinity(); });
    refused("too many", [](Summary& s) { s.counts[0] = s.counts[1] = std::uint64_t{1} << 62; });
}

struct FormulaWithBlanks : VoxelSource {
    base::Status read(const Box& box, std::span<float> out) override {
        std::size_t i = 0;
        for (std::int64_t z = box.lo[2]; z <= box.hi[2]; ++z) {
            for (std::int64_t y = box.lo[1]; y <= box.hi[1]; ++y) {
                for (std::int64_t x = box.lo[0]; x <= box.hi[0]; ++x) {
                    out[i++] = (x + y + z) % 11 == 0 ? nan_value : static_cast<float>(x * 100 + y * 10 - z);
                }
            }
        }
        return {};
    }
    bool concurrent() const override { return true; }
};

// Whatever pieces a box is read in, what it does not own included.
TEST(CountingSource, CountsWhatABoxOwns) {
    const Index3 n{20, 9, 14};
    FormulaWithBlanks formula;
    base::Workers workers(2);
    for (const Box& box :
         {Box{{0, 0, 0}, {19, 8, 13}}, Box{{0, 0, 0}, {10, 8, 6}}, Box{{10, 0, 6}, {19, 8, 13}}}) {
        const Histogram wanted = count_values(formula, box, n, workers).value();
        CountingSource counting(formula, box, n);
        workers.for_each(box.planes(2), [&](std::int64_t i) {
            Box plane = box;
            plane.lo[2] = plane.hi[2] = box.lo[2] + i;
            std::vector<float> values(static_cast<std::size_t>(plane.planes(0) * plane.planes(1)));
            ASSERT_TRUE(counting.read(plane, values));
        });
        const Histogram counted = counting.histogram();
        EXPECT_EQ(counted.filled(), wanted.filled());
        EXPECT_EQ(counted.blank(), wanted.blank());
    }
}

}  // namespace
}  // namespace shearwater::volume
