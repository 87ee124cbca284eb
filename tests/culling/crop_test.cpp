// Culling of a cropped cube: blocks that are cut hide nothing, since their functions are of all of them.

#include <gtest/gtest.h>

#include <random>

#include "deploy/bench/culled_pictures.h"
#include "tests/culling/block.h"
#include "tests/support/reference_cubes.h"

namespace shearwater::culling {
namespace {

using volume::Box;

Box box_at_random(std::mt19937& random, const volume::Index3& n) {
    Box box;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto any = [&] { return static_cast<std::int64_t>(random()) % n[a]; };
        const std::int64_t one = any(), other = any();
        box.lo[a] = std::min({one, other, n[a] - 2});
        box.hi[a] = std::max({one, other, box.lo[a] + 1});
    }
    return box;
}

TEST(CullingCropped, ChangesNoPicture) {
    base::Workers workers(2);
    std::mt19937 random(11);
    test::FloatCube waves = shells({110, 90, 101}), noise = test::noise_cube({110, 90, 101});
    for (test::FloatCube* const cube : {&waves, &noise}) {
        const auto volume = test::bricks_of(*cube, workers);
        const view::Lattice lattice{.n = cube->n(), .spacing = {1, 1, 1}};
        for (const Kind kind : {Kind::opof, Kind::opof_linear, Kind::pof}) {
            Culler culler(volume, lattice.spacing, BlockGrid::default_edge, 12);
            for (int n = 0; n < 4; ++n) {
                const auto tf = bench::function_at_random(random);
                const auto camera = bench::camera_at_random(random, lattice);
                const auto p = bench::compare(volume, culler, {.kind = kind}, tf, camera, {96, 80}, lattice,
                                              bench::sampling_at_random(random), workers,
                                              box_at_random(random, cube->n()));
                EXPECT_LE(p.difference, 1.0 / 255) << n;
            }
        }
    }
}

// Fog that hides what is behind a block of it, and a box that leaves next to nothing of that block.
TEST(CullingCropped, CutBlocksHideNothing) {
    base::Workers workers(2);
    test::FloatCube cube({128, 128, 128}, [](double, double, double) { return 0.5F; });
    const auto volume = test::bricks_of(cube, workers);
    const view::Lattice lattice{.n = cube.n(), .spacing = {1, 1, 1}};
    const view::TransferFunction tf{.opacity_pins = {view::Flat{0.5}}, .colour_pins = {{0, {1, 1, 1}}}};
    const view::Camera camera =
        view::camera_on({0, 0, 300, {}}, lattice, view::Projection::parallel, 30, 120);
    const auto visible = [&](const std::optional<Box>& crop) {
        const auto f = view::factorise(camera, {90, 90}, lattice, {}, crop);
        Culler culler(volume, lattice.spacing, BlockGrid::default_edge, 12);
        culler.prepare(tf, Kind::opof, f.level(), workers);
        return culler.visible(f, tf, {.kind = Kind::opof}, workers);
    };
    // Seen from the upper end of axis 2: a block's depth is enough of it.
    const auto all = visible({});
    const auto seen = [&](const VisibleBlocks& of, std::int64_t z) {
        return of.blocks.contains(of.grid.index({1, 1, z}));
    };
    EXPECT_TRUE(seen(all, 3));
    EXPECT_FALSE(seen(all, 2));
    const auto cut = visible(Box{{0, 0, 0}, {127, 127, 98}});
    EXPECT_TRUE(seen(cut, 2));
    EXPECT_FALSE(seen(cut, 1));
    const auto cut_to_two = visible(Box{{0, 0, 0}, {127, 127, 66}});
    EXPECT_TRUE(seen(cut_to_two, 1));
    EXPECT_FALSE(seen(cut_to_two, 0));
    // And beside the box's sides nothing is hidden by what is outside.
    const auto narrow = visible(Box{{40, 40, 0}, {60, 60, 127}});
    EXPECT_TRUE(seen(narrow, 0));
}

}  // namespace
}  // namespace shearwater::culling
