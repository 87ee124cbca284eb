#include "renderer/shear/kernel.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace shearwater::shear {
namespace {

TEST(OpacityOf, IsAccurateFromTinyToOpaque) {
    for (double depth = 1e-9; depth < 2000; depth *= 1.01) {
        const double exact = -std::expm1(-depth);
        EXPECT_NEAR(static_cast<double>(opacity_of(static_cast<float>(depth))) / exact, 1, 2e-6) << depth;
    }
    EXPECT_EQ(opacity_of(0), 0);
    EXPECT_LE(opacity_of(1e30F), 1);
}

view::TransferFunction coloured() {
    return {.opacity_pins = {view::Ramp{0.2, 0, 1, 0.9}, view::Blank{0.5, 0.6}},
            .colour_pins = {{0, {1, 0, 0.5}}, {1, {0, 1, 0.25}}}};
}

TEST(OpacityTable, HoldsTheTransferFunction) {
    const view::TransferFunction tf = coloured();
    for (const int levels : {255, 65535}) {
        const OpacityTable table(tf, levels);
        for (int code = 1; code <= levels; code += levels / 85) {
            const double s = static_cast<double>(code - 1) / (levels - 1);
            const int i = static_cast<int>(static_cast<float>(code) * table.scale() + table.bias());
            ASSERT_NEAR(static_cast<double>(i) / (OpacityTable::entries - 1), s,
                        0.51 / (OpacityTable::entries - 1));
            EXPECT_NEAR(table.data()[i].g, tf.colour(s).g, 2e-4);
        }
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

// The definition in double precision, sample by sample.
template <class Code>
void expect_span(bool blanks, int width, std::ptrdiff_t stride, float u, float u_scale) {
    std::mt19937 random(static_cast<unsigned>(width) * 7 + static_cast<unsigned>(stride));
    const int levels = sizeof(Code) == 1 ? 255 : 65535;
    const int cells = 12;
    std::vector<Code> rows(static_cast<std::size_t>(2 * stride * (cells + 1)));
    for (Code& code : rows) {
        code = static_cast<Code>(1 + random() % static_cast<unsigned>(levels));
        if (blanks && random() % 3 == 0) {
            code = 0;
        }
    }
    const view::TransferFunction tf{.opacity_pins = {view::Ramp{0.1, 0, 1, 0.8}},
                                    .colour_pins = {{0, {1, 0, 0.5}}, {1, {0, 1, 0.25}}}};
    const OpacityTable table(tf, levels);
    const auto count = static_cast<std::size_t>(width);
    std::vector<float> lengths(count), r(count), g(count), b(count), a(count);
    for (std::size_t n = 0; n < count; ++n) {
        lengths[n] = 0.5F + static_cast<float>(n % 5) * 0.3F;
        a[n] = n % 4 == 3 ? 1.0F : 0.1F * static_cast<float>(n % 4);
        g[n] = 0.05F;
    }
    const auto a0 = a;
    const Code* const row1 = rows.data() + stride * (cells + 1);
    const VoxelRows<Code> voxels{rows.data(), row1, stride, cells, 0.3F, u, u_scale};
    const RaySpan rays{r.data(), g.data(), b.data(), a.data()};
    const int taken = blanks ? composite_span<Code, true>(voxels, lengths, table, rays)
                             : composite_span<Code, false>(voxels, lengths, table, rays);
    int live = 0;
    for (std::size_t n = 0; n < count; ++n) {
        double red = 0, green = 0.05F, alpha = static_cast<double>(a0[n]);
        if (a0[n] < opaque_enough) {
            ++live;
            const double at = static_cast<double>(u) + static_cast<double>(n) * static_cast<double>(u_scale);
            const int cell = std::min(std::max(static_cast<int>(std::floor(at)), 0), cells - 1);
            const Code* const corners = rows.data() + cell * stride;
            const std::ptrdiff_t up = stride * (cells + 1);
            const std::array<Code, 4> codes{corners[0], corners[stride], corners[up], corners[up + stride]};
            const double fu = at - cell, fv = 0.3;
            const std::array<double, 4> weights{(1 - fu) * (1 - fv), fu * (1 - fv), (1 - fu) * fv, fu * fv};
            double sum = 0, valid = 0;
            for (std::size_t corner = 0; corner < 4; ++corner) {
                sum += weights[corner] * codes[corner];
                valid += codes[corner] == 0 ? 0 : weights[corner];
            }
            if (valid >= 0.5) {
                const double s = (sum / valid - 1) / (levels - 1);
                const double sample = -std::expm1(-tf.extinction(s) * static_cast<double>(lengths[n]));
                red += (1 - alpha) * sample * tf.colour(s).r;
                green += (1 - alpha) * sample * tf.colour(s).g;
                alpha += (1 - alpha) * sample;
            }
        }
        EXPECT_NEAR(static_cast<double>(r[n]), red, 5e-4) << n;
        EXPECT_NEAR(static_cast<double>(g[n]), green, 5e-4) << n;
        EXPECT_NEAR(static_cast<double>(a[n]), alpha, 5e-4) << n;
    }
    EXPECT_EQ(taken, live);
}

TEST(CompositeSpan, IsItsDefinitionAtEveryWidthAndStride) {
    for (int width = 0; width <= 35; ++width) {
        for (const std::ptrdiff_t stride : {1, 3, 33}) {
            for (const bool blanks : {false, true}) {
                const float scale = width > 1 ? 11.9F / static_cast<float>(width - 1) : 1;
                expect_span<std::uint8_t>(blanks, width, stride, 0.01F, scale);
                expect_span<std::uint16_t>(blanks, width, stride, 11.93F, -scale);
            }
        }
    }
}

// A sample that rounding puts just outside the brick takes the brick's edge.
TEST(CompositeSpan, ReadsNothingOutsideItsRows) {
    const std::vector<std::uint8_t> row{200, 200};
    const OpacityTable table(coloured(), 255);
    for (const float u : {-1e-6F, 1.000001F, 1.0F, 0.0F}) {
        float r = 0, g = 0, b = 0, a = 0;
        const float length = 1;
        composite_span<std::uint8_t, false>({row.data(), row.data(), 1, 1, 1.0F, u, 1}, {&length, 1}, table,
                                            {&r, &g, &b, &a});
        EXPECT_NEAR(static_cast<double>(a), coloured().opacity(199.0 / 254), 1e-3);
    }
}

}  // namespace
}  // namespace shearwater::shear
