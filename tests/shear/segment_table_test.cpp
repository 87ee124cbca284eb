// The table of pre-integrated classification beside numerical integration.

#include "renderer/shear/segment_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace shearwater::shear {
namespace {

using view::Flat;
using view::Hat;
using view::Ramp;
using view::TransferFunction;

TransferFunction with(std::vector<view::OpacityPin> pins) {
    return {.opacity_pins = std::move(pins),
            .colour_pins = {{0, {1, 0, 0.5}}, {0.6, {0, 1, 0.25}}, {1, {1, 1, 1}}}};
}

// Of a segment between two nodes.
struct SegmentLook {
    double tau;  // mean extinction
    view::Rgb colour;
};

SegmentLook by_table(const SegmentTable& table, int from, int to) {
    const SegmentTable::Node& a = table.nodes()[from];
    const SegmentTable::Node& b = table.nodes()[to];
    const auto sum = [](float whole_a, float rest_a, float whole_b, float rest_b) {
        return static_cast<double>((whole_b - whole_a) + (rest_b - rest_a));
    };
    const double depth = sum(a.depth, a.depth_rest, b.depth, b.depth_rest);
    return {depth / (to - from) * std::log(2.0),
            {sum(a.r, a.r_rest, b.r, b.r_rest) / depth, sum(a.g, a.g_rest, b.g, b.g_rest) / depth,
             sum(a.b, a.b_rest, b.b, b.b_rest) / depth}};
}

SegmentLook by_integration(const TransferFunction& tf, const SegmentTable& table, int levels, int from,
                           int to) {
    const auto s_of = [&](double node) {
        const double code = node / static_cast<double>(table.nodes_per_code());
        return std::clamp((code - 1) / (levels - 1), 0.0, 1.0);
    };
    const int steps = 200 * std::abs(to - from) + 20000;
    SegmentLook mean{};
    for (int i = 0; i < steps; ++i) {
        const double s = s_of(from + (to - from) * (i + 0.5) / steps);
        const double tau = tf.extinction(s);
        const view::Rgb colour = tf.colour(s);
        mean.tau += tau / steps;
        mean.colour.r += tau * colour.r;
        mean.colour.g += tau * colour.g;
        mean.colour.b += tau * colour.b;
    }
    const double all = mean.tau * steps;
    return {mean.tau, {mean.colour.r / all, mean.colour.g / all, mean.colour.b / all}};
}

TEST(SegmentTable, IsTheIntegral) {
    std::mt19937 random(3);
    const std::vector<TransferFunction> functions{
        with({Ramp{0.2, 0, 1, 0.9}}),
        with({Hat{0.4, 0.003, 0.003, 0.5}, Hat{0.47, 0, 0.05, 0.9}}),
        with({Flat{0.01}, Hat{0.5, 0.2, 0.3, 0.999}, view::Blank{0.44, 0.447}}),
    };
    for (const TransferFunction& tf : functions) {
        for (const int levels : {255, 65535}) {
            const SegmentTable table(tf, levels, OpacityTable(tf, levels));
            const int last = table.node_of(static_cast<float>(levels));
            for (int trial = 0; trial < 40; ++trial) {
                // Half of them short and about the hats.
                const int from = trial % 2 == 0 ? static_cast<int>(random() % static_cast<unsigned>(last))
                                                : static_cast<int>((0.38 + 0.003 * trial) * last);
                const int length = trial % 2 == 0 ? static_cast<int>(random() % 1000) : 1 + trial;
                const int to = std::clamp(trial % 3 == 0 ? from - length : from + length, 16, last);
                if (to == from) {
                    continue;
                }
                const SegmentLook got = by_table(table, from, to);
                const SegmentLook expected = by_integration(tf, table, levels, from, to);
                ASSERT_NEAR(got.tau, expected.tau, 2e-3 * expected.tau + 1e-6)
                    << levels << ": " << from << " to " << to;
                if (expected.tau > 1e-6) {
                    ASSERT_NEAR(got.colour.r, expected.colour.r, 3e-3);
                    ASSERT_NEAR(got.colour.g, expected.colour.g, 3e-3);
                    ASSERT_NEAR(got.colour.b, expected.colour.b, 3e-3);
                }
            }
        }
    }
}

// Above an opaque hat the integrals are large, and what a step of haze adds to them is not lost.
TEST(SegmentTable, KeepsHazeBesideAnOpaqueHat) {
    for (const double haze : {1e-4, 1e-3, 1e-2}) {
        const TransferFunction tf = with({Flat{haze}, Hat{0.3, 0.2, 0.2, 1}});
        for (const int levels : {255, 65535}) {
            const SegmentTable table(tf, levels, OpacityTable(tf, levels));
            const int last = table.node_of(static_cast<float>(levels));
            for (int node = last / 2; node < last; ++node) {
                const SegmentLook got = by_table(table, node, node + 1);
                ASSERT_NEAR(got.tau / -std::log1p(-haze), 1, 1e-3) << haze << ", node " << node;
                const auto s = std::min(1.0, (node + 0.5) / last);
                ASSERT_NEAR(got.colour.g, tf.colour(s).g, 0.02);
            }
        }
    }
}

// Whatever ends a segment has among the codes of a range.
TEST(SegmentTable, KnowsRangesWithoutOpacity) {
    const TransferFunction tf =
        with({Ramp{0.4, 0, 0.6, 0.5}, view::Blank{0.45, 2}, Hat{0.10002, 0.0001, 0.0001, 0.5}});
    for (const int levels : {255, 65535}) {
        const SegmentTable table(tf, levels, OpacityTable(tf, levels));
        EXPECT_FALSE(table.any_opacity(65535, 0));
        const auto code = [&](double s) {
            return static_cast<std::uint16_t>(std::lround(1 + s * (levels - 1)));
        };
        EXPECT_FALSE(table.any_opacity(code(0.46), code(1)));
        EXPECT_FALSE(table.any_opacity(code(0.11), code(0.39)));
        EXPECT_TRUE(table.any_opacity(code(0.09), code(0.11)));  // no sample need lie in the hat
        EXPECT_TRUE(table.any_opacity(code(0.39), code(0.42)));
        std::mt19937 random(5);
        for (int trial = 0; trial < 20000; ++trial) {
            std::array<std::uint16_t, 2> ends;
            for (std::uint16_t& end : ends) {
                end = static_cast<std::uint16_t>(1 + random() % static_cast<unsigned>(levels));
            }
            if (trial % 2 == 0) {
                ends[1] =
                    static_cast<std::uint16_t>(std::min(levels, ends[0] + static_cast<int>(random() % 3)));
            }
            const auto [min, max] = std::minmax(ends[0], ends[1]);
            // Nearly the whole range, or one of its ends alone, a rounding error beyond.
            for (const auto& [a, b] : {std::pair{min * 0.99999F, max * 1.00001F},
                                       {min * 1.0F, min * 0.99999F},
                                       {max * 1.0F, max * 1.00001F}}) {
                int from = table.node_of(a), to = table.node_of(b);
                if (from == to) {
                    --from;
                    ++to;
                }
                const bool seen = by_table(table, std::min(from, to), std::max(from, to)).tau > 0;
                ASSERT_TRUE(!seen || table.any_opacity(min, max)) << levels << ": " << min << " to " << max;
            }
        }
    }
}

TEST(SegmentTable, GathersSharesOfOneHue) {
    const TransferFunction tf{.opacity_pins = {Flat{0.2}},
                              .colour_pins = {{0, {0, 0, 0}}, {1, {0.8, 0.4, 0.2}}}};
    const OpacityTable colours(tf, 255);
    ASSERT_TRUE(colours.one_hue());
    const SegmentTable table(tf, 255, colours);
    const int middle = table.node_of(128);
    const SegmentLook segment = by_table(table, middle - 100, middle + 100);
    EXPECT_NEAR(segment.colour.r * colours.hue().g, 0.2, 1e-4);
    EXPECT_EQ(segment.colour.g, 0);
}

}  // namespace
}  // namespace shearwater::shear
