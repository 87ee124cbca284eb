#include "common/volume/mapping.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "common/volume/quantiser.h"
#include "tests/support/simd_targets.h"

namespace shearwater::volume {
namespace {

constexpr Stretch stretches[] = {Stretch::linear, Stretch::sqrt, Stretch::log, Stretch::asinh};
constexpr float infinity = std::numeric_limits<float>::infinity();

TEST(Mapping, StretchesFollowTheirFormulas) {
    EXPECT_DOUBLE_EQ(apply(Stretch::linear, 0.3), 0.3);
    EXPECT_DOUBLE_EQ(apply(Stretch::sqrt, 0.25), 0.5);
    EXPECT_DOUBLE_EQ(apply(Stretch::log, 1.0 / 111), 1.0 / 3);
    EXPECT_DOUBLE_EQ(apply(Stretch::asinh, 0.5), std::asinh(5.0) / std::asinh(10.0));
    for (const Stretch stretch : stretches) {
        EXPECT_DOUBLE_EQ(apply(stretch, 0), 0) << name(stretch);
        EXPECT_DOUBLE_EQ(apply(stretch, 1), 1) << name(stretch);
        EXPECT_EQ(stretch_named(name(stretch)), stretch);
    }
    EXPECT_EQ(stretch_named("cubic"), std::nullopt);
}

TEST(Mapping, InvertUndoesApply) {
    for (const Stretch stretch : stretches) {
        for (int i = 0; i <= 1000; ++i) {
            const double s = i / 1000.0;
            EXPECT_NEAR(apply(stretch, invert(stretch, s)), s, 1e-12) << name(stretch);
        }
    }
}

TEST(Mapping, CodesSpanTheLevelsAndKeepZeroForBlank) {
    for (const int bits : {8, 16}) {
        const Mapping mapping{.lo = -2, .hi = 6, .bits = bits};
        const int last = (1 << bits) - 1;
        EXPECT_EQ(mapping.levels(), last);
        EXPECT_EQ(mapping.code(-2), 1);
        EXPECT_EQ(mapping.code(-100), 1);
        EXPECT_EQ(mapping.code(6), last);
        EXPECT_EQ(mapping.code(1e30), last);
        EXPECT_EQ(mapping.code(2), 1 + (last - 1) / 2);
        EXPECT_EQ(mapping.code(std::nan("")), 0);
        EXPECT_EQ(mapping.code(infinity), 0);
        EXPECT_EQ(mapping.code(-infinity), 0);
        EXPECT_DOUBLE_EQ(mapping.s_of_code(1), 0);
        EXPECT_DOUBLE_EQ(mapping.s_of_code(last), 1);
    }
}

TEST(Mapping, ValueOfCodeIsWithinHalfAStep) {
    for (const Stretch stretch : stretches) {
        const Mapping mapping{.lo = -1, .hi = 3, .stretch = stretch};
        for (double value = -1; value <= 3; value += 0.001) {
            const double s = mapping.s_of_code(mapping.code(value));
            EXPECT_LE(std::abs(s - mapping.stretched(value)), 0.5 / (mapping.levels() - 1) + 1e-12);
            EXPECT_NEAR(mapping.value_of_s(mapping.stretched(value)), value, 1e-9);
        }
    }
}

TEST(Mapping, ConstantCubeIsZeroAtTheValueAndOneAbove) {
    const Mapping mapping{.lo = 5, .hi = 5};
    EXPECT_EQ(mapping.stretched(5), 0);
    EXPECT_EQ(mapping.stretched(4), 0);
    EXPECT_EQ(mapping.stretched(5.001), 1);
}

// Values of every size, many close to where codes change.
std::vector<float> trying(const Mapping& mapping) {
    std::mt19937 random(7);
    std::vector<float> values = {0.0F,   -0.0F,   infinity, -infinity, std::nanf(""),
                                 1e-45F, -1e-45F, 3.4e38F,  -3.4e38F};
    for (int i = 0; i < 50000; ++i) {
        values.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(random())));
    }
    std::uniform_real_distribution<double> inside(-0.05, 1.05);
    for (int i = 0; i < 50000; ++i) {
        values.push_back(static_cast<float>(mapping.lo + (mapping.hi - mapping.lo) * inside(random)));
    }
    for (int code = 1; code < mapping.levels(); ++code) {
        auto edge = static_cast<float>(mapping.value_of_s((code - 0.5) / (mapping.levels() - 1)));
        edge = std::nextafter(std::nextafter(edge, -infinity), -infinity);
        for (int i = 0; i < 5; ++i, edge = std::nextafter(edge, infinity)) {
            values.push_back(edge);
        }
    }
    return values;
}

template <class Code>
void expect_same_codes(const Mapping& mapping) {
    const std::vector<float> values = trying(mapping);
    std::vector<Code> codes(values.size());
    Quantiser(mapping).codes(values, codes);
    for (std::size_t i = 0; i < values.size(); ++i) {
        ASSERT_EQ(codes[i], mapping.code(values[i]))
            << values[i] << " of " << mapping.lo << ".." << mapping.hi << " " << name(mapping.stretch);
    }
}

void expect_the_mapping() {
    const std::pair<double, double> limits[] = {
        {0, 1},        {-0.0412, 0.157}, {1e6, 1e6 + 1},  {-3e38, 3e38}, {1e-40, 3e-40},
        {8e-16, 6e-5}, {5, 5},           {-1e-45, 1e-45}, {0.1, 0.1},    {-7, 1e30}};
    for (const auto& [lo, hi] : limits) {
        for (const Stretch stretch : stretches) {
            expect_same_codes<std::uint8_t>({.lo = lo, .hi = hi, .stretch = stretch, .bits = 8});
            expect_same_codes<std::uint16_t>({.lo = lo, .hi = hi, .stretch = stretch, .bits = 8});
        }
    }
    for (const Stretch stretch : stretches) {
        expect_same_codes<std::uint16_t>({.lo = -0.0412, .hi = 0.157, .stretch = stretch, .bits = 16});
        expect_same_codes<std::uint16_t>({.lo = 1e-40, .hi = 3e-40, .stretch = stretch, .bits = 16});
    }
}

TEST(Quantiser, EqualsTheMappingExactly) {
    support::for_each_target(expect_the_mapping);
}

template <class Code>
void expect_odd_lengths(const Mapping& mapping) {
    const Quantiser quantiser(mapping);
    const std::vector<float> all = trying(mapping);
    for (std::size_t count = 0; count < 100; ++count) {
        const std::size_t shift = count % 7;
        const std::span<const float> values = std::span(all).subspan(60000 + shift, count);
        std::vector<Code> codes(shift + count + 1, 77);
        quantiser.codes(values, std::span(codes).subspan(shift, count));
        for (std::size_t i = 0; i < count; ++i) {
            ASSERT_EQ(codes[shift + i], mapping.code(values[i])) << i << " of " << count;
        }
        EXPECT_EQ(codes.back(), 77);
    }
}

TEST(Quantiser, TakesAnyNumberOfValuesAnywhere) {
    support::for_each_target([] {
        for (const Stretch stretch : stretches) {
            expect_odd_lengths<std::uint8_t>({.lo = -1, .hi = 2, .stretch = stretch, .bits = 8});
            expect_odd_lengths<std::uint16_t>({.lo = -1, .hi = 2, .stretch = stretch, .bits = 8});
            expect_odd_lengths<std::uint16_t>({.lo = -1, .hi = 2, .stretch = stretch, .bits = 16});
        }
    });
}

// Limits whose distance is none, or too small or too great for a division by it.
TEST(Quantiser, EqualsTheMappingWhereItsScaleOverflows) {
    const std::pair<double, double> limits[] = {{-1e-310, 1e-310}, {0, 5e-324},   {-5e-324, -5e-324}, {0, 0},
                                                {-1e308, 1.7e308}, {1e-320, 1e30}};
    support::for_each_target([&] {
        for (const auto& [lo, hi] : limits) {
            for (const Stretch stretch : stretches) {
                expect_same_codes<std::uint8_t>({.lo = lo, .hi = hi, .stretch = stretch, .bits = 8});
            }
        }
    });
}

}  // namespace
}  // namespace shearwater::volume
