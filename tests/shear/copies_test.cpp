// A second copy of the codes, turned: it holds what the first does, and pictures are the same.

#include <gtest/gtest.h>

#include "common/image/warp.h"
#include "tests/support/reference_raycaster.h"
#include "tests/support/reference_views.h"

namespace shearwater::test {
namespace {

using shear::BrickVolume;
using shear::CodeArray;
using volume::Box;
using volume::Index3;

template <class Code>
void expect_same_codes(const CodeArray& a, const CodeArray& b) {
    ASSERT_EQ(a.box(), b.box());
    Index3 p;
    for (p[2] = a.box().lo[2]; p[2] <= a.box().hi[2]; ++p[2]) {
        for (p[1] = a.box().lo[1]; p[1] <= a.box().hi[1]; ++p[1]) {
            for (p[0] = a.box().lo[0]; p[0] <= a.box().hi[0]; ++p[0]) {
                ASSERT_EQ(a.codes<Code>()[a.offset(p)], b.codes<Code>()[b.offset(p)])
                    << p[0] << ", " << p[1] << ", " << p[2];
            }
        }
    }
}

TEST(Copies, HoldTheSameCodesOnEveryLevel) {
    base::Workers workers(3);
    FloatCube cube = blanked(noise_cube({133, 71, 66}), 1009);
    for (const Box& box : {volume::whole(cube.n()), Box{{31, 0, 33}, {33, 40, 65}}, Box{{5, 6, 7}, {6, 7, 8}},
                           Box{{32, 0, 0}, {95, 64, 32}}}) {
        for (const int bits : {8, 16}) {
            BrickVolume volume = bricks_of(cube, box, workers, {.bits = bits});
            const std::size_t one = volume.bytes();
            for (int level = 0; level < volume.levels(); ++level) {
                EXPECT_EQ(volume.level(level).best_for(0).adjacent_axis(), 0) << "there is no other";
            }
            ASSERT_TRUE(volume.keep_copies(2, workers));
            EXPECT_GT(volume.bytes(), one + static_cast<std::size_t>(box.voxels() * bits / 8));
            for (int level = 0; level < volume.levels(); ++level) {
                const auto& codes = volume.level(level);
                EXPECT_EQ(codes.best_for(1).adjacent_axis(), 0);
                EXPECT_EQ(codes.best_for(2).adjacent_axis(), 0);
                ASSERT_EQ(codes.best_for(0).adjacent_axis(), 1);
                bits == 8 ? expect_same_codes<std::uint8_t>(codes.best_for(0), codes.best_for(1))
                          : expect_same_codes<std::uint16_t>(codes.best_for(0), codes.best_for(1));
            }
        }
    }
}

TEST(Copies, AreNotMadeOnceStopped) {
    base::Workers workers(2);
    FloatCube cube = noise_cube({20, 21, 22});
    BrickVolume volume = bricks_of(cube, volume::whole(cube.n()), workers, {});
    std::stop_source stop;
    stop.request_stop();
    const auto kept = volume.keep_copies(2, workers, stop.get_token());
    ASSERT_FALSE(kept);
    EXPECT_EQ(kept.error().code, base::Code::cancelled);
}

struct CopiesDrawn {
    int bits = 8;
    view::Sampling sampling{};
    view::ImageSize size{90, 70};
};

void expect_as_of_one_copy(FloatCube& cube, const CopiesDrawn& taking) {
    base::Workers workers;
    const view::Lattice lattice{cube.n(), {1, 1.3, 0.8}};
    const volume::Mapping mapping{.bits = taking.bits};
    const BrickVolume one = bricks_of(cube, volume::whole(cube.n()), workers, mapping);
    BrickVolume two = bricks_of(cube, volume::whole(cube.n()), workers, mapping);
    ASSERT_TRUE(two.keep_copies(2, workers));
    int across_first = 0;
    for (const NamedView& view : all_views(lattice, 3)) {
        const auto factorisation = view::factorise(view.camera, taking.size, lattice, taking.sampling);
        across_first += factorisation.faces.front().axis == 0 ? 1 : 0;
        const auto picture = [&](const BrickVolume& volume) {
            const auto [windows, stats] = shear::render(volume, factorisation, ramp_to(0.2), workers);
            return std::pair(
                image::warp(factorisation, windows, view.camera, taking.size, {0, 0, 0}, workers),
                stats.samples);
        };
        const auto [a, a_samples] = picture(one);
        const auto [b, b_samples] = picture(two);
        EXPECT_LE(largest_difference(a, b), 1) << view.name;
        EXPECT_NEAR(static_cast<double>(a_samples), static_cast<double>(b_samples),
                    0.02 * static_cast<double>(a_samples))
            << view.name << ": rays end alike, tile by tile";
    }
    EXPECT_GT(across_first, 3);
}

TEST(Copies, GiveTheSamePictures) {
    FloatCube cube = blanked(noise_cube({131, 67, 97}), 1009);
    for (const int bits : {8, 16}) {
        expect_as_of_one_copy(cube, {.bits = bits});
        expect_as_of_one_copy(cube, {.bits = bits, .sampling = {.classify = view::Classify::pre_integrated}});
        expect_as_of_one_copy(cube, {.bits = bits, .sampling = {.level_of_detail = true}, .size = {41, 31}});
    }
}

}  // namespace
}  // namespace shearwater::test
