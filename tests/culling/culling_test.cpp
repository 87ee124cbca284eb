// Pictures with culling beside pictures without.

#include <gtest/gtest.h>

#include <random>

#include "deploy/bench/culled_pictures.h"
#include "tests/culling/block.h"
#include "tests/support/reference_cubes.h"

namespace shearwater::culling {
namespace {

void expect_no_difference(test::FloatCube& cube, int pictures, unsigned seed, const Settings& settings,
                          double bound, int side = DirectionGrid::default_side) {
    base::Workers workers(2);
    std::mt19937 random(seed);
    std::uint64_t culled = 0, opaque = 0;
    const auto volume = test::bricks_of(cube, workers);
    const view::Lattice lattice{.n = cube.n(), .spacing = {1, 1, 1}};
    Culler culler(volume, lattice.spacing, BlockGrid::default_edge, side);
    for (int n = 0; n < pictures; ++n) {
        const auto tf = bench::function_at_random(random);
        const auto camera = bench::camera_at_random(random, lattice);
        const auto sampling = bench::sampling_at_random(random);
        const auto p =
            bench::compare(volume, culler, settings, tf, camera, {96, 80}, lattice, sampling, workers);
        EXPECT_LE(p.difference, bound) << seed << ", " << n;
        culled += p.with.bricks_culled;
        opaque += p.with.bricks_total - p.with.bricks_empty;
    }
    std::cout << 100.0 * static_cast<double>(culled) / static_cast<double>(opaque) << " % culled\n";
    EXPECT_TRUE(culled > 0 || settings.kind == Kind::pof);
}

TEST(Culling, ChangesNoPicture) {
    test::FloatCube waves = shells({110, 90, 101});
    test::FloatCube noise = test::noise_cube({110, 90, 101});
    for (const Kind kind : {Kind::opof, Kind::opof_linear, Kind::pof}) {
        expect_no_difference(waves, 6, 1, {.kind = kind}, 1.0 / 255, 12);
        expect_no_difference(noise, 6, 2, {.kind = kind}, 1.0 / 255, 12);
        expect_no_difference(noise, 6, 3, {.kind = kind, .threshold = 0.95}, 0.05, 12);
    }
    expect_no_difference(waves, 6, 4, {.kind = Kind::opof, .threshold = 0.95}, 0.05);
}

}  // namespace
}  // namespace shearwater::culling
