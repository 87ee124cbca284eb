// The kernel for segments in the form of every target beside its definition.

#include "renderer/shear/segments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/composited_rays.h"
#include "tests/support/simd_targets.h"

namespace shearwater::shear {
namespace {

using Outcome = test::CompositedRays;

constexpr int slab_rows = 9, slab_cells = 32, ray_rows = 12;
constexpr std::ptrdiff_t row_of_rays = widest_tile + ray_padding, plane_rows = slab_rows + 1;

view::TransferFunction hats() {
    return {.opacity_pins = {view::Hat{0.3, 0.01, 0.01, 0.6}, view::Hat{0.6, 0, 0.2, 0.4}, view::Flat{0.001}},
            .colour_pins = {{0, {1, 0, 0.5}}, {1, {0, 1, 0.25}}}};
}

// Segments between slices of random voxels, before random rays.
template <class Code>
struct SegmentTrial {
    std::mt19937 random;
    std::vector<Code> voxels;
    std::vector<float> lengths;
    SegmentSlab<Code> slab{};

    SegmentTrial(unsigned seed, bool blanks, int ends, bool halves, std::ptrdiff_t stride)
        : random(seed),
          voxels(static_cast<std::size_t>(stride * plane_rows * 11) + voxel_padding),
          lengths(static_cast<std::size_t>(row_of_rays * ray_rows)) {
        // Values near one another, so that short segments are among them, and equal ones.
        const int levels = sizeof(Code) == 1 ? 255 : 65535;
        for (Code& code : voxels) {
            const int spread = random() % 4 == 0 ? levels : levels / 50;
            code = static_cast<Code>(
                1 + (levels / 4 + static_cast<int>(random() % static_cast<unsigned>(spread))) % levels);
            code = random() % 3 == 0 ? static_cast<Code>(levels / 3) : code;
            code = blanks && random() % 3 == 0 ? Code{0} : code;
        }
        for (float& length : lengths) {
            length = 0.25F + static_cast<float>(random() % 8) * 0.25F;
        }
        slab.samples = {.fast_first = 5,
                        .slow_first = 7,
                        .fast_cells = slab_cells,
                        .slow_cells = slab_rows,
                        .stride = stride,
                        .ahead = {},
                        .fast_pixel = 100,
                        .slow_pixel = 60,
                        .blanks = blanks,
                        .between_nodes = true,
                        .count = ends,
                        .slices = {}};
        for (int k = 0; k < ends; ++k) {
            const Code* const plane = voxels.data() + k * stride * plane_rows;
            slab.samples.slices[static_cast<std::size_t>(k)] = {
                .voxels = plane,
                .next = halves && k % 2 == 1 ? plane + stride * plane_rows : nullptr,
                .lengths = nullptr};
        }
    }

    // The pixels [i0, i1) of every slice lie between two voxels; segments between all slices that follow one
    // another, and some that end where they begin.
    void place(int i0, int i1, double from, double to) {
        const int ends = slab.samples.count;
        slab.count = 0;
        const auto add = [&](int front, int back, const view::Rect& pixels) {
            if (!pixels.empty()) {
                slab.segments[static_cast<std::size_t>(slab.count++)] = {front, back, pixels, lengths.data()};
            }
        };
        for (int k = 0; k < ends; ++k) {
            Slice<Code>& slice = slab.samples.slices[static_cast<std::size_t>(k)];
            slice.pixels = {i0, 0, i1, ray_rows};
            slice.fast_scale = (to - from) / std::max(i1 - i0 - 1, 1) * (1 - 0.01 * k);
            slice.fast_offset = from - slice.fast_scale * (i0 + 100) + 5;
            slice.slow_scale = (slab_rows - 0.02 * k) / (ray_rows - 1);
            slice.slow_offset = 0.01 * k - slice.slow_scale * 60 + 7;
            add(k, k, {i0, k % 3, std::min(i0 + 1 + k, i1), ray_rows});
            if (k + 1 < ends) {
                add(k, k + 1, {std::min(i0 + k % 3, i1 - 1), k % 4, i1, ray_rows - k % 3});
            }
        }
    }

    template <class Composite>
    Outcome run(const SegmentTable& table, const Composite& composite, float done = view::opaque_enough) {
        return test::composited_rays(
            lengths.size(), row_of_rays, [&](const Rays& rays) { return composite(slab, table, rays); },
            done);
    }

    void expect_definition(const SegmentTable& table, float done = view::opaque_enough) {
        const Outcome expected = run(table, composite_segments_by_definition<Code>, done);
        const Outcome got = run(table, composite_segments<Code>, done);
        EXPECT_EQ(got.taken, expected.taken);
        // As much as an end may differ by that lies between two nodes, and goes to one or the other.
        constexpr float tolerance = 0.02F;
        double sum = 0;
        for (std::size_t n = 0; n < lengths.size(); ++n) {
            ASSERT_NEAR(got.a[n], expected.a[n], tolerance) << n;
            ASSERT_NEAR(got.r[n], expected.r[n], tolerance) << n;
            ASSERT_NEAR(got.g[n], expected.g[n], tolerance) << n;
            ASSERT_NEAR(got.b[n], expected.b[n], tolerance) << n;
            sum += static_cast<double>(std::abs(got.a[n] - expected.a[n]));
        }
        EXPECT_LT(sum / static_cast<double>(lengths.size()), 1e-4);
    }
};

template <class Code>
void expect_definition(bool blanks) {
    const SegmentTable table(hats(), sizeof(Code) == 1 ? 255 : 65535,
                             OpacityTable(hats(), sizeof(Code) == 1 ? 255 : 65535));
    for (const int ends : {1, 2, 5, 9}) {
        for (const bool halves : {false, true}) {
            SegmentTrial<Code> trial(static_cast<unsigned>(ends), blanks, ends, halves, 47);
            SCOPED_TRACE(testing::Message()
                         << "ends " << ends << ", halves " << halves << ", blanks " << blanks);
            for (const int width : {1, 2, 15, 16, 17, 33, 64}) {
                for (const int i0 : {0, 13}) {
                    SCOPED_TRACE(testing::Message() << "from " << i0 << ", width " << width);
                    trial.place(i0, i0 + width, 0.01, 31.97);
                    trial.expect_definition(table);
                    trial.place(i0, i0 + width, 20.2, 3.1);
                    trial.expect_definition(table, 0.25F);
                }
            }
        }
    }
}

TEST(Segments, AreCompositedAsDefinedOnEveryTarget) {
    support::for_each_target([] {
        for (const bool blanks : {false, true}) {
            expect_definition<std::uint8_t>(blanks);
            expect_definition<std::uint16_t>(blanks);
        }
    });
}

// One ray, one voxel column: what a segment makes of its two ends, by the formula.
struct Column {
    std::vector<std::uint8_t> voxels = std::vector<std::uint8_t>(voxel_padding);
    std::vector<float> lengths = std::vector<float>(row_of_rays, 2);
    SegmentSlab<std::uint8_t> slab{};

    double alpha(const view::TransferFunction& tf, std::uint8_t front, std::uint8_t back) {
        std::fill_n(voxels.begin(), 8, front);
        std::fill_n(voxels.begin() + 8, 8, back);
        slab.samples = {.fast_first = 0,
                        .slow_first = 0,
                        .fast_cells = 1,
                        .slow_cells = 1,
                        .stride = 4,
                        .ahead = {},
                        .fast_pixel = 0,
                        .slow_pixel = 0,
                        .blanks = front == 0 || back == 0,
                        .between_nodes = true,
                        .count = 2,
                        .slices = {}};
        for (std::size_t k = 0; k < 2; ++k) {
            slab.samples.slices[k] = {.voxels = voxels.data() + 8 * k,
                                      .next = nullptr,
                                      .fast_offset = 0.5,
                                      .fast_scale = 1,
                                      .slow_offset = 0.5,
                                      .slow_scale = 1,
                                      .pixels = {0, 0, 1, 1},
                                      .lengths = nullptr};
        }
        slab.count = 1;
        slab.segments[0] = {0, 1, {0, 0, 1, 1}, lengths.data()};
        std::vector<float> r(row_of_rays), g = r, b = r, a = r;
        composite_segments(slab, SegmentTable(tf, 255, OpacityTable(tf, 255)),
                           {r.data(), g.data(), b.data(), a.data(), row_of_rays});
        EXPECT_NEAR(r[0], a[0], 1e-5);
        return static_cast<double>(a[0]);
    }
};

TEST(SegmentBetweenTwoValues, SeesTheHatThatNoSampleLiesIn) {
    const view::TransferFunction hat{.opacity_pins = {view::Hat{0.5, 10.0 / 254, 10.0 / 254, 0.5}},
                                     .colour_pins = {{0, {1, 1, 1}}}};
    Column column;
    // Ten codes of the hundred that the segment of length 2 passes through.
    const double expected = -std::expm1(-std::log(2.0) * 0.1 * 2);
    EXPECT_NEAR(column.alpha(hat, 78, 178), expected, 1e-4);
    EXPECT_NEAR(column.alpha(hat, 178, 78), expected, 1e-4);
    EXPECT_NEAR(column.alpha(hat, 128, 128), 0.75, 1e-4);  // within it
    EXPECT_EQ(column.alpha(hat, 10, 100), 0);
}

TEST(SegmentBetweenTwoValues, CountsByHalfWithOneValidEnd) {
    const view::TransferFunction flat{.opacity_pins = {view::Flat{0.5}}, .colour_pins = {{0, {1, 1, 1}}}};
    Column column;
    EXPECT_NEAR(column.alpha(flat, 0, 50), 0.5, 1e-4);
    EXPECT_NEAR(column.alpha(flat, 50, 0), 0.5, 1e-4);
    EXPECT_NEAR(column.alpha(flat, 50, 60), 0.75, 1e-4);
    EXPECT_EQ(column.alpha(flat, 0, 0), 0);
}

}  // namespace
}  // namespace shearwater::shear
