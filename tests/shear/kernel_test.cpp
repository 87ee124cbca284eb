// The opacity table, and the kernel in the form of every target beside its definition.

#include "renderer/shear/kernel.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/composited_rays.h"

namespace shearwater::shear {
namespace {

using Outcome = test::CompositedRays;

view::TransferFunction coloured() {
    return {.opacity_pins = {view::Ramp{0.2, 0, 1, 0.9}, view::Blank{0.5, 0.6}},
            .colour_pins = {{0, {1, 0, 0.5}}, {1, {0, 1, 0.25}}}};
}

TEST(OpacityTable, HoldsTheTransferFunction) {
    const view::TransferFunction tf = coloured();
    for (const int levels : {255, 65535}) {
        const OpacityTable table(tf, levels);
        const double unit = static_cast<double>(table.depth_unit()) * std::log(2.0);
        const int step = static_cast<int>(1 / table.nodes_per_code());
        for (int code = step; code <= levels; code += step) {
            const double s = static_cast<double>(code - 1) / (levels - 1);
            const OpacityTable::Node& node = table.nodes()[code / step];
            EXPECT_NEAR(static_cast<double>(node.g), tf.colour(s).g, 1e-6);
            // Apart from the edges of the blank and where the ramp begins, it is smooth.
            const bool smooth =
                std::abs(s - 0.5) > 0.004 && std::abs(s - 0.6) > 0.004 && std::abs(s - 0.2) > 0.004;
            if (smooth) {
                EXPECT_NEAR(static_cast<double>(node.extinction) * unit, tf.extinction(s), 2e-4) << s;
            }
        }
    }
}

TEST(OpacityTable, KnowsOneHue) {
    const auto table_of = [](const std::vector<view::ColourPin>& pins) {
        return OpacityTable({.opacity_pins = {view::Flat{0.1}}, .colour_pins = pins}, 255);
    };
    EXPECT_TRUE(table_of({{0, {1, 1, 1}}}).one_hue());
    EXPECT_TRUE(table_of({{0, {0, 0, 0}}, {1, {1, 1, 1}}}).one_hue());
    EXPECT_TRUE(table_of({{0, {0, 0, 0}}, {0.4, {0.5, 0.25, 0}}, {1, {1, 0.5, 0}}}).one_hue());
    EXPECT_FALSE(table_of({{0, {0, 0, 0}}, {1, {1, 1, 0.99}}, {0.5, {1, 1, 1}}}).one_hue());
    EXPECT_FALSE(table_of(*view::colour_map("inferno")).one_hue());
    const OpacityTable table = table_of({{0, {0, 0, 0}}, {1, {0.8, 0.4, 0.2}}});
    EXPECT_NEAR(static_cast<double>(table.nodes()[128].r) * table.hue().g, 0.2, 1e-6);
    EXPECT_EQ(table.nodes()[128].g, 0);
    const OpacityTable black = table_of({{0, {0, 0, 0}}});
    EXPECT_TRUE(black.one_hue());
    EXPECT_EQ(black.nodes()[9].r * static_cast<float>(black.hue().r), 0);
}

// A pin between two nodes has the same weight as a whole, however narrow.
TEST(OpacityTable, MissesNoPin) {
    for (const double centre : {0.3, 0.30093, 0.3017}) {
        for (const double width : {0.0002, 0.001, 0.004}) {
            const view::TransferFunction tf{.opacity_pins = {view::Hat{centre, width, width, 0.5}},
                                            .colour_pins = {{0, {1, 1, 1}}}};
            for (const int levels : {255, 65535}) {
                const OpacityTable table(tf, levels);
                double sum = 0;
                const int nodes = static_cast<int>(static_cast<float>(levels) * table.nodes_per_code());
                for (int i = 0; i <= nodes; ++i) {
                    sum +=
                        static_cast<double>(table.nodes()[i].extinction * table.depth_unit()) * std::log(2.0);
                }
                const double expected = std::log(2.0) * width * nodes;
                EXPECT_NEAR(sum / expected, 1, 0.3) << centre << ", " << width << ", " << levels;
            }
        }
    }
}

TEST(OpacityTable, SpansNineDecadesInWords) {
    for (const double faint : {1e-6, 1e-4, 1e-2, 0.5}) {
        const view::TransferFunction tf{.opacity_pins = {view::Flat{faint}, view::Hat{1, 0.1, 0.1, 1}},
                                        .colour_pins = {{0, {1, 1, 1}}}};
        const OpacityTable table(tf, 255);
        const OpacityTable::Bytes::Word& words = table.bytes().extinction;
        const std::uint32_t word = static_cast<std::uint32_t>(words.high[100] << 8 | words.low[100]);
        const auto extinction = std::bit_cast<float>(word << OpacityTable::Bytes::extinction_shift);
        EXPECT_NEAR(static_cast<double>(extinction / table.nodes()[100].extinction), 1, 3e-4) << faint;
    }
}

TEST(OpacityTable, KnowsRangesWithoutOpacity) {
    const OpacityTable table(coloured(), 255);
    EXPECT_FALSE(table.any_opacity(1, 50));
    EXPECT_TRUE(table.any_opacity(1, 60));
    EXPECT_FALSE(table.any_opacity(130, 151));  // the blank pin
    EXPECT_TRUE(table.any_opacity(130, 160));
    EXPECT_TRUE(table.any_opacity(255, 255));
    EXPECT_FALSE(table.any_opacity(65535, 0));  // all blank
    for (int min = 1; min <= 255; ++min) {
        for (int max = min; max <= 255; ++max) {
            bool any = false;
            for (int code = min; code <= max && !any; ++code) {
                any = coloured().opacity((code - 1) / 254.0) > 0;
            }
            ASSERT_TRUE(!any ||
                        table.any_opacity(static_cast<std::uint16_t>(min), static_cast<std::uint16_t>(max)));
        }
    }
}

constexpr int rows = 9, cells = 32, tile_rows = 12;
constexpr std::ptrdiff_t ray_stride = widest_tile + ray_padding;

struct Ends {
    double from, to;  // voxels that the first and the last pixel lie at
};

// A slab of random voxels before random rays.
template <class Code>
struct Trial {
    std::mt19937 random;
    std::vector<Code> voxels;
    std::vector<float> lengths;
    Slab<Code> slab;

    Trial(unsigned seed, bool blanks, bool between_nodes, int slices, bool halves, std::ptrdiff_t stride)
        : random(seed),
          voxels(static_cast<std::size_t>(stride * (rows + 1) * 10) + voxel_padding),
          lengths(static_cast<std::size_t>(ray_stride * tile_rows)) {
        for (Code& code : voxels) {
            code = static_cast<Code>(1 + random() % (sizeof(Code) == 1 ? 255 : 65535));
            code = blanks && random() % 3 == 0 ? Code{0} : code;
        }
        for (float& length : lengths) {
            length = 0.25F + static_cast<float>(random() % 8) * 0.25F;
        }
        slab = {.fast_first = 5,
                .slow_first = 7,
                .fast_cells = cells,
                .slow_cells = rows,
                .stride = stride,
                .ahead = {},
                .fast_pixel = 100,
                .slow_pixel = 60,
                .blanks = blanks,
                .between_nodes = between_nodes,
                .count = slices,
                .slices = {}};
        for (int k = 0; k < slices; ++k) {
            const Code* const plane = voxels.data() + k * stride * (rows + 1);
            slab.slices[static_cast<std::size_t>(k)] = {
                .voxels = plane,
                .next = halves && k % 2 == 1 ? plane + stride * (rows + 1) : nullptr,
                .lengths = lengths.data()};
        }
    }

    // The pixels [i0, i1) of every slice, a little more or less, lie between two voxels.
    void place(int i0, int i1, const Ends& ends) {
        for (int k = 0; k < slab.count; ++k) {
            Slice<Code>& slice = slab.slices[static_cast<std::size_t>(k)];
            const int first = std::min(i0 + k % 3, i1 - 1);
            slice.pixels = {first, k % 4, i1, tile_rows - k % 3};
            slice.fast_scale = i1 - first > 1 ? (ends.to - ends.from) / (i1 - first - 1) : 1;
            slice.fast_offset = ends.from - slice.fast_scale * (first + 100) + 5;
            slice.slow_scale = (rows - 0.02 * k) / (tile_rows - 1);
            slice.slow_offset = 0.01 * k - slice.slow_scale * 60 + 7;
        }
    }

    // The rays after it, by the kernel or by its definition.
    template <class Composite>
    Outcome run(const OpacityTable& table, const Composite& composite, float done = view::opaque_enough) {
        return test::composited_rays(
            lengths.size(), ray_stride, [&](const Rays& rays) { return composite(slab, table, rays); }, done);
    }

    void expect_definition(const OpacityTable& table, float done = view::opaque_enough) {
        std::vector<float> scaled = lengths;
        for (float& length : scaled) {
            length *= table.depth_unit();
        }
        for (Slice<Code>& slice : slab.slices) {
            slice.lengths = scaled.data();
        }
        slab.faint = *std::ranges::max_element(scaled) * OpacityTable::largest <= few_halvings;
        const Outcome expected = run(table, composite_slab_by_definition<Code>, done);
        const Outcome got = run(table, composite_slab<Code>, done);
        EXPECT_EQ(got.taken, expected.taken);
        // As much as a few samples that lie between two nodes may differ by, taking one or the other.
        constexpr float tolerance = 7e-3F;
        for (std::size_t n = 0; n < lengths.size(); ++n) {
            ASSERT_NEAR(got.a[n], expected.a[n], tolerance) << n;
            ASSERT_NEAR(got.r[n], expected.r[n], tolerance) << n;
            ASSERT_NEAR(got.g[n], expected.g[n], tolerance) << n;
            ASSERT_NEAR(got.b[n], expected.b[n], tolerance) << n;
        }
    }
};

// Smooth enough that a code's last bit changes little; the nearest node's extinction may do where it changes
// little from node to node.
view::TransferFunction smooth() {
    return {.opacity_pins = {view::Ramp{0.1, 0, 1, 0.3}},
            .colour_pins = {{0, {1, 0, 0.5}}, {0.5, {0, 1, 0.25}}, {1, {0.3, 0.6, 1}}}};
}

view::TransferFunction in_one_hue() {
    return {.opacity_pins = smooth().opacity_pins, .colour_pins = {{0, {0, 0, 0}}, {0.7, {0.8, 0.4, 0.2}}}};
}

// Every code has a little opacity.
view::TransferFunction faint() {
    return {.opacity_pins = {view::Flat{0.02}}, .colour_pins = smooth().colour_pins};
}

template <class Code>
void expect_definition(bool blanks, bool between_nodes, const view::TransferFunction& tf = smooth()) {
    const OpacityTable table(tf, sizeof(Code) == 1 ? 255 : 65535);
    for (const std::ptrdiff_t stride : {33, 48}) {
        for (const int slices : {1, 2, 3, 8}) {
            for (const bool halves : {false, true}) {
                Trial<Code> trial(static_cast<unsigned>(slices), blanks, between_nodes, slices, halves,
                                  stride);
                SCOPED_TRACE(testing::Message()
                             << "stride " << stride << ", slices " << slices << ", halves " << halves
                             << ", blanks " << blanks << ", between " << between_nodes);
                for (const int width : {1, 2, 5, 15, 16, 17, 31, 32, 33, 47, 64}) {
                    for (const int i0 : {0, 1, 13}) {
                        SCOPED_TRACE(testing::Message() << "from " << i0 << ", width " << width);
                        const int i1 = std::min(i0 + width, widest_tile);
                        trial.place(i0, i1, {0.01, 31.97});
                        trial.expect_definition(table);
                        trial.place(i0, i1, {20.2, 3.1});
                        trial.expect_definition(table, 0.25F);
                    }
                }
            }
        }
    }
}

// Whatever vectors this processor has, all the way down.
class EveryTarget : public testing::TestWithParam<std::int64_t> {
  protected:
    void SetUp() override { hwy::SetSupportedTargetsForTest(GetParam()); }
    void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
};

TEST_P(EveryTarget, CompositesAsDefined) {
    for (const bool between_nodes : {false, true}) {
        expect_definition<std::uint8_t>(false, between_nodes);
        expect_definition<std::uint8_t>(true, between_nodes);
    }
    expect_definition<std::uint8_t>(false, false, faint());
    expect_definition<std::uint8_t>(false, false, in_one_hue());
    expect_definition<std::uint8_t>(true, true, in_one_hue());
    expect_definition<std::uint16_t>(false, true);
    expect_definition<std::uint16_t>(true, true);
}

// Samples that rounding puts just outside a brick take its edge; nothing is read beyond what may be.
TEST_P(EveryTarget, TakesTheEdgeForWhatIsBarelyOutside) {
    const OpacityTable table(smooth(), 255);
    Trial<std::uint8_t> trial(1, false, true, 4, true, 33);
    for (const double off : {-1e-7, 0.0, 1e-7}) {
        trial.place(3, 40, {off, cells - off});
        for (Slice<std::uint8_t>& slice : trial.slab.slices) {
            slice.slow_scale = (rows - off / 500) / (tile_rows - 1);
            slice.slow_offset = off / 1000 - slice.slow_scale * 60 + 7;
        }
        trial.expect_definition(table);
    }
}

// From a wisp to a wall, as the formula has it.
TEST_P(EveryTarget, HasTheOpacityOfTheDepth) {
    for (double depth = 1e-7; depth < 50; depth *= 1.7) {
        const view::TransferFunction tf{.opacity_pins = {view::Flat{0.5}}, .colour_pins = {{0, {1, 1, 1}}}};
        const OpacityTable table(tf, 255);
        for (const bool blanks : {false, true}) {
            Trial<std::uint8_t> trial(2, false, false, 1, false, 33);
            trial.slab.blanks = blanks;
            trial.place(0, 20, {0.5, 20.5});
            const double length = depth / std::log(2.0);
            std::fill(trial.lengths.begin(), trial.lengths.end(),
                      static_cast<float>(length) * table.depth_unit());
            trial.slab.slices[0].lengths = trial.lengths.data();
            std::vector<float> r(trial.lengths.size()), g = r, b = r, a = r;
            composite_slab(trial.slab, table, {r.data(), g.data(), b.data(), a.data(), ray_stride});
            EXPECT_NEAR(static_cast<double>(a[5]) / -std::expm1(-depth), 1, 3e-4) << depth;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(OfThisProcessor, EveryTarget, testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& tested) { return std::string(hwy::TargetName(tested.param)); });

}  // namespace
}  // namespace shearwater::shear
