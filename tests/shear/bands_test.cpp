// A frame rendered band by band is the frame rendered at once.

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/shear/render.h"
#include "tests/support/reference_cubes.h"

namespace shearwater::shear {
namespace {

using test::FloatCube;
using view::Band;

const view::Lattice lattice{.n = {40, 33, 29}, .spacing = {1, 1, 1}};

FloatCube waves() {
    return FloatCube(lattice.n, [](double x, double y, double z) {
        return static_cast<float>(0.5 + 0.5 * std::sin(0.3 * x + 0.2 * y) * std::cos(0.25 * z));
    });
}

view::TransferFunction thin() {
    return {.opacity_pins = {view::Ramp{.x0 = 0.2, .a0 = 0, .x1 = 1, .a1 = 0.1}},
            .colour_pins = {{0, {0.2, 0.4, 1}}, {1, {1, 0.8, 0.1}}},
            .background = {}};
}

// Cameras for which rows run along each of the axes, and one inside.
std::vector<view::Camera> cameras() {
    return {view::camera_on({.azimuth = 10, .elevation = 5}, lattice),
            view::camera_on({.azimuth = 95, .elevation = 10}, lattice),
            view::camera_on({.azimuth = 20, .elevation = 80}, lattice),
            view::camera_on({.azimuth = 30, .elevation = 25, .distance = 4.0}, lattice,
                            view::Projection::perspective, 120)};
}

struct Banded {
    std::vector<DrawnBands> drawn;
    RenderStats stats;
};

Banded render_in_bands(const BrickVolume& volume, const view::Factorisation& f, base::Workers& workers) {
    const Classification classification = classify(volume, thin(), view::Classify::post, workers);
    Banded banded;
    const auto keep = [&](DrawnBands drawn) { banded.drawn.push_back(std::move(drawn)); };
    banded.stats = render_bands(volume, classification, f, view::bands_of(f), workers, keep);
    return banded;
}

// Told in order, one after the other, to the last, and each window fills what the whole window has of its
// band.
void expect_whole(const Banded& banded, std::span<const image::Window> whole, std::span<const Band> bands) {
    std::size_t known = 0;
    std::int64_t pixels = 0;
    for (const DrawnBands& drawn : banded.drawn) {
        ASSERT_GT(drawn.bands, known);
        known = drawn.bands;
        if (drawn.window.rect.empty()) {
            continue;
        }
        const Band& band = bands[drawn.bands - 1];
        const auto of = std::ranges::find(whole, band.face, &image::Window::face);
        ASSERT_NE(of, whole.end());
        EXPECT_EQ(drawn.window.face, band.face);
        EXPECT_EQ(drawn.window.rect, view::intersection(of->rect, band.rect));
        pixels += drawn.window.rect.area();
        for (int y = drawn.window.rect.y0; y < drawn.window.rect.y1; ++y) {
            for (int x = drawn.window.rect.x0; x < drawn.window.rect.x1; ++x) {
                const auto& got = drawn.window.pixels.at(x - drawn.window.rect.x0, y - drawn.window.rect.y0);
                const auto& wanted = of->pixels.at(x - of->rect.x0, y - of->rect.y0);
                ASSERT_NEAR(got.a, wanted.a, 1e-3) << x << ", " << y;
                ASSERT_NEAR(got.g, wanted.g, 1e-3) << x << ", " << y;
            }
        }
    }
    EXPECT_EQ(known, bands.size());
    std::int64_t all = 0;
    for (const image::Window& window : whole) {
        all += window.rect.area();
    }
    EXPECT_EQ(pixels, all);
}

TEST(RenderBands, AreTogetherTheWholeFrame) {
    FloatCube cube = waves();
    for (const int threads : {1, 3}) {
        base::Workers workers(threads);
        const BrickVolume volume = test::bricks_of(cube, workers);
        for (const view::Camera& camera : cameras()) {
            const auto f = view::factorise(camera, {560, 500}, lattice, {1});
            const auto bands = view::bands_of(f);
            ASSERT_GE(bands.size(), 3U);
            const auto [whole, stats] = render(volume, f, thin(), workers);
            const Banded banded = render_in_bands(volume, f, workers);
            expect_whole(banded, whole, bands);
            EXPECT_EQ(banded.stats.bricks_rendered, stats.bricks_rendered);
        }
    }
}

// A sub-volume that reaches into some bands says of the others that it has nothing, together.
TEST(RenderBands, WithNothingInThemAreToldTogether) {
    FloatCube cube = waves();
    base::Workers workers(2);
    const volume::Box box{{0, 0, 0}, {40 - 1, 8, 29 - 1}};
    const BrickVolume volume = test::bricks_of(cube, box, workers);
    const auto f = view::factorise(cameras()[0], {520, 500}, lattice, {1});
    const Banded banded = render_in_bands(volume, f, workers);
    ASSERT_FALSE(banded.drawn.empty());
    EXPECT_LT(banded.drawn.size(), view::bands_of(f).size());
    for (std::size_t i = 0; i + 1 < banded.drawn.size(); ++i) {
        EXPECT_FALSE(banded.drawn[i].window.rect.empty() && banded.drawn[i + 1].window.rect.empty());
    }
    EXPECT_EQ(banded.drawn.back().bands, view::bands_of(f).size());
}

// Bands are told while later ones are still to be drawn.
TEST(RenderBands, StopBetweenTwo) {
    FloatCube cube = waves();
    base::Workers workers(1);
    const BrickVolume volume = test::bricks_of(cube, workers);
    const Classification classification = classify(volume, thin(), view::Classify::post, workers);
    const auto f = view::factorise(cameras()[0], {560, 500}, lattice, {1});
    std::stop_source stop;
    std::size_t told = 0;
    const auto stop_at_once = [&](const DrawnBands& drawn) {
        told = drawn.bands;
        stop.request_stop();
    };
    render_bands(volume, classification, f, view::bands_of(f), workers, stop_at_once,
                 {.stop = stop.get_token()});
    EXPECT_GE(told, 1U);
    EXPECT_LT(told, view::bands_of(f).size());
}

}  // namespace
}  // namespace shearwater::shear
