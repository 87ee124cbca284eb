// Pictures with culling beside pictures without.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/image/warp.h"
#include "renderer/culling/culler.h"
#include "renderer/shear/render.h"
#include "tests/culling/block.h"
#include "tests/support/reference_cubes.h"

namespace shearwater::culling {
namespace {

using image::Image;
using image::RgbaF;
using view::Camera;
using view::Factorisation;
using view::ImageSize;

struct Pictures {
    double difference;  // the greatest of any channel
    shear::RenderStats with, without;
};

// One view with and without.
Pictures compare(const shear::BrickVolume& volume, Culler& culler, const view::TransferFunction& tf,
                 const Settings& settings, const Camera& camera, const ImageSize& size,
                 const view::Lattice& lattice, const view::Sampling& sampling, base::Workers& workers) {
    const Factorisation f = view::factorise(camera, size, lattice, sampling);
    const auto classification = shear::classify(volume, tf, f.classify, workers);
    culler.prepare(tf, settings.kind, f.level(), workers);
    const VisibleBlocks visible = culler.visible(f, tf, settings, workers);
    Pictures pictures{};
    const auto draw = [&](const VisibleBlocks* blocks, shear::RenderStats& stats) {
        const auto windows = shear::render(volume, classification, f, workers, &stats, {}, blocks);
        return image::warp_float(f, windows, camera, size, workers);
    };
    const auto with = draw(&visible, pictures.with), without = draw(nullptr, pictures.without);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const RgbaF& a = with.at(x, y);
            const RgbaF& b = without.at(x, y);
            for (const float d : {a.r - b.r, a.g - b.g, a.b - b.b, a.a - b.a}) {
                pictures.difference = std::max(pictures.difference, static_cast<double>(std::abs(d)));
            }
        }
    }
    return pictures;
}

// A camera at random: far, near or inside; perspective or parallel.
Camera camera_at_random(std::mt19937& random, const view::Lattice& lattice) {
    std::uniform_real_distribution<double> share(0, 1);
    const double diagonal = lattice.diagonal();
    const bool parallel = share(random) < 0.3;
    view::Orbit orbit{.azimuth = 360 * share(random), .elevation = 170 * share(random) - 85};
    const std::array distances{0.0, 0.7 * diagonal, 0.25 * diagonal};
    orbit.distance = distances[static_cast<std::size_t>(3 * share(random))];
    return view::camera_on(orbit, lattice,
                           parallel ? view::Projection::parallel : view::Projection::perspective,
                           25 + 70 * share(random), parallel ? diagonal * (0.3 + share(random)) : 0);
}

view::TransferFunction function_at_random(std::mt19937& random) {
    std::uniform_real_distribution<double> share(0, 1);
    view::TransferFunction tf{
        .opacity_pins = {}, .colour_pins = {{0, {0.2, 0.3, 1}}, {1, {1, 0.8, 0.3}}}, .background = {}};
    const double height = std::pow(share(random), 2);
    tf.opacity_pins.push_back(view::Ramp{0.6 * share(random),
                                         share(random) < 0.4 ? 0.05 + 0.1 * share(random) : 0,
                                         0.7 + 0.3 * share(random), height + 0.01});
    if (share(random) < 0.5) {
        tf.opacity_pins.push_back(view::Hat{share(random), 0.1 * share(random), 0.1 + 0.3 * share(random),
                                            0.99 * share(random) + 0.01});
    }
    if (share(random) < 0.3) {
        tf.opacity_pins.push_back(view::Flat{0.1 * share(random) + 0.001});
    }
    if (share(random) < 0.3) {
        const double lo = share(random);
        tf.opacity_pins.push_back(view::Blank{lo, std::min(lo + 0.2 * share(random), 1.0)});
    }
    return tf;
}

void expect_no_difference(test::FloatCube& cube, int pictures, unsigned seed, const Settings& settings,
                          double bound, int side = DirectionGrid::default_side) {
    base::Workers workers(2);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    std::uint64_t culled = 0, opaque = 0;
    const auto volume = test::bricks_of(cube, workers);
    const view::Lattice lattice{.n = cube.n(), .spacing = {1, 1, 1}};
    Culler culler(volume, lattice.spacing, BlockGrid::default_edge, side);
    for (int n = 0; n < pictures; ++n) {
        const auto tf = function_at_random(random);
        const Camera camera = camera_at_random(random, lattice);
        const auto quality = share(random) < 0.2   ? view::Quality::high
                             : share(random) < 0.3 ? view::Quality::draft
                                                   : view::Quality::normal;
        const auto p = compare(volume, culler, tf, settings, camera, {96, 80}, lattice,
                               view::sampling(quality, share(random) < 0.3), workers);
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
