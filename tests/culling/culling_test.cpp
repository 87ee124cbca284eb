// Pictures with culling beside pictures without.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "common/image/warp.h"
#include "deploy/bench/culled_pictures.h"
#include "renderer/shear/render.h"
#include "tests/culling/block.h"
#include "tests/support/reference_cubes.h"

namespace shearwater::culling {
namespace {

struct Pictures {
    int count;
    unsigned seed;
    Settings settings;
    double bound;
    int side = DirectionGrid::default_side;
    // Transfer functions and how they are applied: all sorts, or top-hats, pre-integrated.
    bool sharp = false;
};

void expect_no_difference(test::FloatCube& cube, const Pictures& pictures) {
    base::Workers workers(2);
    std::mt19937 random(pictures.seed);
    std::uint64_t culled = 0, opaque = 0;
    const auto volume = test::bricks_of(cube, workers);
    const view::Lattice lattice{.n = cube.n(), .spacing = {1, 1, 1}};
    Culler culler(volume, lattice.spacing, BlockGrid::default_edge, pictures.side);
    for (int n = 0; n < pictures.count; ++n) {
        const auto tf =
            pictures.sharp ? bench::top_hats_at_random(random) : bench::function_at_random(random);
        const auto camera = bench::camera_at_random(random, lattice);
        auto sampling = bench::sampling_at_random(random);
        if (pictures.sharp) {
            sampling.classify = view::Classify::pre_integrated;
        }
        const auto p = bench::compare(volume, culler, pictures.settings, tf, camera, {96, 80}, lattice,
                                      sampling, workers);
        EXPECT_LE(p.difference, pictures.bound) << pictures.seed << ", " << n;
        culled += p.with.bricks_culled;
        opaque += p.with.bricks_total - p.with.bricks_empty;
    }
    std::cout << 100.0 * static_cast<double>(culled) / static_cast<double>(opaque) << " % culled\n";
    EXPECT_TRUE(culled > 0 || pictures.settings.kind == Kind::pof);
}

class CullingKinds : public testing::TestWithParam<Kind> {};

TEST_P(CullingKinds, ChangeNoPictureOfShells) {
    test::FloatCube waves = shells({110, 90, 101});
    expect_no_difference(waves, {6, 1, {.kind = GetParam()}, 1.0 / 255, 12});
}

TEST_P(CullingKinds, ChangeNoPictureOfNoise) {
    test::FloatCube noise = test::noise_cube({110, 90, 101});
    expect_no_difference(noise, {12, 1, {.kind = GetParam()}, 1.0 / 255, 12});
    expect_no_difference(noise, {12, 1, {.kind = GetParam(), .threshold = 0.95}, 0.05, 12});
}

INSTANTIATE_TEST_SUITE_P(All, CullingKinds, testing::Values(Kind::opof, Kind::opof_linear, Kind::pof),
                         [](const auto& tested) {
                             std::string name(kind_names[static_cast<std::size_t>(tested.param)]);
                             std::ranges::replace(name, '-', '_');  // names of tests have none
                             return name;
                         });

// What opof shows opof-linear does, and what that shows pof does, block by block.
TEST(Culling, OfEachKindLeavesOutWhatThoseBeforeItDo) {
    test::FloatCube noise = test::noise_cube({110, 90, 101});
    base::Workers workers(2);
    std::mt19937 random(8);
    const auto volume = test::bricks_of(noise, workers);
    const view::Lattice lattice{.n = noise.n(), .spacing = {1, 1, 1}};
    Culler culler(volume, lattice.spacing, 16, 12);
    std::size_t fewer = 0;
    for (int n = 0; n < 12; ++n) {
        const auto tf = bench::function_at_random(random);
        const auto camera = bench::camera_at_random(random, lattice);
        const auto f =
            view::factorise(camera, {96, 80}, lattice, view::sampling(view::Quality::normal, false));
        std::optional<BlockSet> before;
        for (const Kind kind : {Kind::pof, Kind::opof_linear, Kind::opof}) {
            culler.prepare(tf, kind, 0, workers);
            BlockSet seen = culler.visible(f, tf, {.kind = kind, .threshold = 0.95}, workers).blocks;
            for (std::size_t block = 0; before && block < seen.bytes().size(); ++block) {
                ASSERT_LE(seen.bytes()[block], before->bytes()[block]) << n << ", block " << block;
                fewer += seen.bytes()[block] < before->bytes()[block] ? 1 : 0;
            }
            before = std::move(seen);
        }
    }
    EXPECT_GT(fewer, 100U);
}

TEST(Culling, OfAllDirectionsChangesNoPicture) {
    test::FloatCube waves = shells({110, 90, 101});
    expect_no_difference(waves, {3, 4, {.kind = Kind::opof, .threshold = 0.95}, 0.05});
}

// Where nothing is hidden, rays end at the threshold all the same: what lies behind is taken to be as what
// they have, which is wrong by no more than it weighs.
TEST(Culling, EndsRays) {
    base::Workers workers(2);
    test::FloatCube noise = test::noise_cube({70, 60, 50});
    const auto volume = test::bricks_of(noise, workers);
    const view::Lattice lattice{.n = noise.n(), .spacing = {1, 1, 1}};
    const auto camera = view::camera_on({.azimuth = 20, .elevation = 10}, lattice);
    const view::ImageSize size{96, 80};
    for (const auto classify : {view::Classify::post, view::Classify::pre_integrated}) {
        auto f =
            view::factorise(camera, size, lattice, view::sampling(view::Quality::normal, false, classify));
        struct Drawn {
            image::Image<image::RgbaF> picture;
            shear::RenderStats stats;
        };
        const auto draw = [&] {
            const auto [windows, stats] = shear::render(volume, f, ramp(0, 0.1, 1, 0.3), workers);
            return Drawn{image::warp_float(f, windows, camera, size, workers), stats};
        };
        const Drawn all = draw();
        double before = 1;
        for (const double threshold : {0.998, 0.95, 0.8}) {
            const Settings settings{.kind = Kind::opof, .threshold = threshold};
            f.opaque = settings.opaque();
            EXPECT_GT(f.opaque, threshold);
            const Drawn some = draw();
            const double share =
                static_cast<double>(some.stats.samples) / static_cast<double>(all.stats.samples);
            EXPECT_LT(share, 0.97 * before) << threshold;
            before = share;
            for (std::size_t n = 0; n < all.picture.pixels().size(); ++n) {
                const image::RgbaF& a = all.picture.pixels()[n];
                const image::RgbaF& b = some.picture.pixels()[n];
                for (const float d : {a.r - b.r, a.g - b.g, a.b - b.b, a.a - b.a}) {
                    ASSERT_LE(std::abs(d), 1 - threshold) << n;
                }
            }
            EXPECT_NEAR(some.picture.at(size.width / 2, size.height / 2).a, 1, 1e-6)
                << "nothing shines through";
        }
    }
    EXPECT_EQ(Settings{}.opaque(), double{view::opaque_enough});
    EXPECT_EQ((Settings{.kind = Kind::pof, .threshold = 0.99999}).opaque(), double{view::opaque_enough});
}

// Whatever way a ray goes, so thin a fog hides nothing: that is known without following any.
TEST(Culling, NothingHidesInThinFog) {
    base::Workers workers(2);
    test::FloatCube noise = test::noise_cube({70, 60, 50});
    const auto volume = test::bricks_of(noise, workers);
    const view::Lattice lattice{.n = noise.n(), .spacing = {1, 1, 2}};
    Culler culler(volume, lattice.spacing, 16, 12);
    // The way from corner to corner is 153 voxels' smallest distances or less.
    for (const double depth : {2.9, 40.0}) {
        const double height = 1 - std::exp(-depth / 153);
        const view::TransferFunction tf = ramp(0, height, 1, height);
        for (const double azimuth : {0.0, 45.0}) {
            const auto camera = view::camera_on({.azimuth = azimuth, .elevation = 35}, lattice);
            const auto f = view::factorise(camera, {96, 80}, lattice, view::sampling(view::Quality::normal));
            culler.prepare(tf, Kind::opof, 0, workers);
            const auto visible = culler.visible(f, tf, {.kind = Kind::opof, .threshold = 0.95}, workers);
            EXPECT_EQ(visible.blocks.count() == visible.blocks.size(), depth < 3) << depth << ", " << azimuth;
        }
    }
}

// A sub-volume of which nothing is visible sends no pixels, and one of which little is those of that little.
TEST(Culling, DrawsNoMoreThanIsVisible) {
    base::Workers workers(2);
    test::FloatCube noise = test::noise_cube({70, 60, 50});
    const auto volume = test::bricks_of(noise, workers);
    const view::Lattice lattice{.n = noise.n(), .spacing = {1, 1, 1}};
    const auto f = view::factorise(view::camera_on({.azimuth = 20, .elevation = 10}, lattice), {96, 80},
                                   lattice, view::sampling(view::Quality::normal));
    const auto classification = shear::classify(volume, ramp(0, 0.1, 1, 0.3), f.classify, workers);
    VisibleBlocks visible{BlockGrid(noise.n()), BlockSet(BlockGrid(noise.n()).size())};
    const auto nothing = shear::render(volume, classification, f, workers, {.visible = &visible});
    EXPECT_TRUE(nothing.windows.empty());
    EXPECT_EQ(nothing.stats.samples, 0U);
    EXPECT_EQ(nothing.stats.bricks_culled, nothing.stats.bricks_total);
    visible.blocks.bytes()[visible.grid.index({1, 1, 0})] = 1;
    const auto stats = shear::render(volume, classification, f, workers, {.visible = &visible}).stats;
    EXPECT_GT(stats.samples, 0U);
    EXPECT_EQ(stats.bricks_culled, stats.bricks_total - 1);
    EXPECT_LE(stats.bricks_rendered, 2U);
}

// Rays along stripes of two neighbouring codes see through a slit between them, where no voxel has it.
TEST(Culling, CountsWhatLiesBetweenCodes) {
    base::Workers workers(2);
    test::FloatCube stripes({110, 90, 101}, [](double x, double y, double z) {
        const auto odd = [](double at) { return std::fmod(at, 2) == 0 ? 0.0 : 1.0; };
        return z < 40 ? static_cast<float>((126 + odd(x) * odd(y)) / 254) : static_cast<float>(x / 110);
    });
    const auto volume = test::bricks_of(stripes, workers);
    const view::Lattice lattice{.n = stripes.n(), .spacing = {1, 1, 1}};
    const view::TransferFunction tf{.opacity_pins = {view::Flat{0.4}, view::Blank{126.45 / 254, 126.7 / 254}},
                                    .colour_pins = {{0, {0.2, 0.3, 1}}, {1, {1, 0.8, 0.3}}},
                                    .background = {}};
    Culler culler(volume, lattice.spacing, BlockGrid::default_edge, 12);
    for (const double elevation : {0.0, 2.0}) {
        for (const bool along : {true, false}) {
            const auto camera = view::camera_on({.azimuth = along ? 180.0 : 90.0, .elevation = elevation},
                                                lattice, view::Projection::parallel, 30, 60);
            const auto p = bench::compare(
                volume, culler, {.kind = Kind::opof}, tf, camera, {96, 80}, lattice,
                view::sampling(view::Quality::high, false, view::Classify::pre_integrated), workers);
            EXPECT_LE(p.difference, 1.0 / 255) << elevation;
            EXPECT_TRUE(along || p.with.bricks_culled > 0);
        }
    }
}

// All that segments pass through counts.
TEST(Culling, ChangesNoPreIntegratedPicture) {
    test::FloatCube waves = shells({110, 90, 101}), noise = test::noise_cube({110, 90, 101});
    expect_no_difference(waves, {6, 5, {.kind = Kind::opof, .threshold = 0.6}, 0.4, 12, true});
    expect_no_difference(noise, {12, 1, {.kind = Kind::opof_linear, .threshold = 0.6}, 0.4, 12, true});
}

}  // namespace
}  // namespace shearwater::culling
