// A cropped cube looks like a cube that ends where it is cropped.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/image/warp.h"
#include "tests/support/reference_raycaster.h"
#include "tests/support/reference_views.h"

namespace shearwater::test {
namespace {

using view::ImageSize;
using view::Lattice;
using view::Vec3;
using volume::Box;
using volume::Index3;

struct Drawn {
    image::Image<image::RgbaF> picture;
    shear::RenderStats stats;
    int level = 0;
};

Drawn draw(const shear::BrickVolume& volume, const Vec3& spacing, const view::TransferFunction& tf,
           const view::Camera& camera, const ImageSize& size, const view::Sampling& sampling,
           const std::optional<Box>& crop) {
    base::Workers workers;
    const auto f = view::factorise(camera, size, {volume.cube(), spacing}, sampling, crop);
    EXPECT_TRUE(view::validate(f));
    Drawn drawn{.picture = {}, .stats = {}, .level = f.level()};
    const auto [windows, stats] = shear::render(volume, f, tf, workers);
    drawn.stats = stats;
    drawn.picture = image::warp_float(f, windows, camera, size, workers);
    return drawn;
}

// The voxels of a box as a cube of their own.
FloatCube part_of(const FloatCube& cube, const Box& box) {
    FloatCube part(box.plane_counts());
    for (std::int64_t z = 0; z < box.planes(2); ++z) {
        for (std::int64_t y = 0; y < box.planes(1); ++y) {
            for (std::int64_t x = 0; x < box.planes(0); ++x) {
                part.at(x, y, z) = cube.at(box.lo[0] + x, box.lo[1] + y, box.lo[2] + z);
            }
        }
    }
    return part;
}

// The camera that sees a part, as a cube of its own, where the given one sees it in the cube.
view::Camera seeing_part(const view::Camera& camera, const Lattice& lattice, const Box& box) {
    const Lattice part{box.plane_counts(), lattice.spacing};
    const Vec3 away =
        lattice.world_from_voxel({static_cast<double>(box.lo[0]), static_cast<double>(box.lo[1]),
                                  static_cast<double>(box.lo[2])}) -
        part.world_from_voxel({0, 0, 0});
    view::Camera moved = camera;
    moved.eye -= away;
    moved.target -= away;
    return moved;
}

double largest(const image::Image<image::RgbaF>& a, const image::Image<image::RgbaF>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        most = std::max<double>(most, std::abs(a.pixels()[i].a - b.pixels()[i].a));
        most = std::max<double>(most, std::abs(a.pixels()[i].r - b.pixels()[i].r));
    }
    return most;
}

constexpr ImageSize size{80, 62};
const Index3 n{43, 37, 51};
const std::array boxes{Box{{5, 9, 11}, {31, 30, 44}}, Box{{0, 0, 20}, {42, 36, 23}},
                       Box{{30, 0, 0}, {42, 36, 50}}};

// To rounding, where in a cell a sample lies, in steps of a 127th; and in a parallel view the intermediate
// pixels lie elsewhere, which shows at edges.
TEST(Crop, IsTheCubeOfItsVoxels) {
    FloatCube cube = smooth_cube(n, 3);
    base::Workers workers;
    const Vec3 spacing{1, 1.3, 0.8};
    const Lattice lattice{n, spacing};
    const auto whole = bricks_of(cube, workers);
    const auto tf = ramp_to(0.3);
    for (const Box& box : boxes) {
        FloatCube part = part_of(cube, box);
        const auto alone = bricks_of(part, workers);
        for (const NamedView& view : all_views(lattice, 5)) {
            for (const auto classify : {view::Classify::post, view::Classify::pre_integrated}) {
                const view::Sampling sampling{.classify = classify};
                const auto cropped = draw(whole, spacing, tf, view.camera, size, sampling, box);
                const auto expected =
                    draw(alone, spacing, tf, seeing_part(view.camera, lattice, box), size, sampling, {});
                const bool parallel = view.camera.projection == view::Projection::parallel;
                EXPECT_LE(largest(cropped.picture, expected.picture), parallel ? 0.08 : 4e-3) << view.name;
                EXPECT_GE(psnr(cropped.picture, expected.picture), parallel ? 55 : 65) << view.name;
            }
        }
    }
}

// Voxels outside take no part in what is drawn inside.
TEST(Crop, DoesNotSeeWhatIsOutside) {
    FloatCube cube = noise_cube(n, 4);
    base::Workers workers;
    const auto tf = ramp_to(0.3);
    for (const Box& box : boxes) {
        FloatCube blanked = noise_cube(n, 4);
        for (std::int64_t z = 0; z < n[2]; ++z) {
            for (std::int64_t y = 0; y < n[1]; ++y) {
                for (std::int64_t x = 0; x < n[0]; ++x) {
                    const Index3 at{x, y, z};
                    for (std::size_t a = 0; a < 3; ++a) {
                        if (at[a] < box.lo[a] || at[a] > box.hi[a]) {
                            blanked.at(x, y, z) = std::numeric_limits<float>::quiet_NaN();
                        }
                    }
                }
            }
        }
        const auto whole = bricks_of(cube, workers), inside = bricks_of(blanked, workers);
        for (const NamedView& view : all_views({n, {1, 1, 1}}, 7)) {
            const auto a = draw(whole, {1, 1, 1}, tf, view.camera, size, {}, box);
            const auto b = draw(inside, {1, 1, 1}, tf, view.camera, size, {}, box);
            // Blanks are interpolated by other, rounder numbers.
            EXPECT_LE(largest(a.picture, b.picture), 3e-3) << view.name;
        }
        // Left as it is, a cube with blanks reaches half a voxel farther every way.
        const NamedView view = all_views({n, {1, 1, 1}}).front();
        const auto a = draw(whole, {1, 1, 1}, tf, view.camera, size, {}, box);
        const auto b = draw(inside, {1, 1, 1}, tf, view.camera, size, {}, {});
        EXPECT_GE(psnr(a.picture, b.picture), 22);
        EXPECT_LT(psnr(a.picture, b.picture), 60);
    }
}

// The whole cube as a box to crop to is no other picture.
TEST(Crop, ToAllIsNone) {
    FloatCube cube = noise_cube(n, 5);
    base::Workers workers;
    const auto volume = bricks_of(cube, workers);
    for (const NamedView& view : all_views({n, {1, 1, 1}}, 5)) {
        for (const view::Sampling& sampling :
             {view::Sampling{}, view::sampling(view::Quality::high),
              view::sampling(view::Quality::draft, true, view::Classify::pre_integrated)}) {
            const auto a = draw(volume, {1, 1, 1}, ramp_to(0.3), view.camera, size, sampling, {});
            const auto b =
                draw(volume, {1, 1, 1}, ramp_to(0.3), view.camera, size, sampling, volume::whole(n));
            EXPECT_EQ(largest(a.picture, b.picture), 0) << view.name;
        }
    }
}

// A homogeneous body's opacity follows from the length that rays have in the box, on every level.
TEST(Crop, KeepsOpacityByTheFormula) {
    const Index3 large{129, 97, 113};
    FloatCube cube(large, [](double, double, double) { return 0.5F; });
    base::Workers workers;
    const auto volume = bricks_of(cube, workers);
    const double tau = 0.02;
    const view::TransferFunction tf{.opacity_pins = {view::Flat{-std::expm1(-tau)}},
                                    .colour_pins = {{0, {1, 1, 1}}}};
    const Lattice lattice{large, {1, 1, 1}};
    int coarse = 0;
    for (const Box& box : {Box{{17, 3, 29}, {110, 70, 99}}, Box{{50, 10, 20}, {59, 90, 100}}}) {
        for (const NamedView& view : views_from(lattice, 28, 17)) {
            for (const int pixels : {31, 140}) {
                const ImageSize small{pixels, pixels};
                const view::Sampling sampling{.level_of_detail = true};
                const auto drawn = draw(volume, {1, 1, 1}, tf, view.camera, small, sampling, box);
                coarse += drawn.level > 0 ? 1 : 0;
                // Of pixels well inside the outline: those whose neighbours' chords are about as long.
                const view::Camera moved = seeing_part(view.camera, lattice, box);
                const auto chord = [&](int x, int y) {
                    return chord_of(box.plane_counts(), {1, 1, 1}, moved, small, x + 0.5, y + 0.5).length;
                };
                for (int y = 2; y < pixels - 2; ++y) {
                    for (int x = 2; x < pixels - 2; ++x) {
                        const double length = chord(x, y);
                        const double change = std::max(
                            {std::abs(chord(x - 2, y) - length), std::abs(chord(x + 2, y) - length),
                             std::abs(chord(x, y - 2) - length), std::abs(chord(x, y + 2) - length)});
                        if (length > 4 && change < 0.05 * length) {
                            EXPECT_NEAR(drawn.picture.at(x, y).a / -std::expm1(-tau * length), 1, 0.01)
                                << view.name << " at " << x << ", " << y;
                        }
                    }
                }
            }
        }
    }
    EXPECT_GT(coarse, 0);
}

TEST(Crop, CostsNothingOutside) {
    FloatCube cube = noise_cube({128, 128, 128}, 6);
    base::Workers workers;
    const auto volume = bricks_of(cube, workers);
    const view::TransferFunction thin{.opacity_pins = {view::Flat{1e-9}}, .colour_pins = {{0, {1, 1, 1}}}};
    const NamedView view = views_from({{128, 128, 128}, {1, 1, 1}}, 30, 20).front();
    const auto all = draw(volume, {1, 1, 1}, thin, view.camera, {200, 200}, {}, {});
    const auto cropped =
        draw(volume, {1, 1, 1}, thin, view.camera, {200, 200}, {}, Box{{33, 33, 33}, {63, 63, 63}});
    EXPECT_EQ(cropped.stats.bricks_rendered, 1);
    EXPECT_EQ(all.stats.bricks_rendered, 64);
    EXPECT_LT(cropped.stats.samples * 50, all.stats.samples);
    EXPECT_GT(cropped.stats.samples, 0);
}

TEST(Crop, ThinnerThanTheCellsOfALevelIsDrawnOnAFinerOne) {
    FloatCube cube(Index3{257, 257, 257}, [](double, double, double) { return 0.5F; });
    base::Workers workers;
    const auto volume = bricks_of(cube, workers);
    const Lattice lattice{cube.n(), {1, 1, 1}};
    const view::Camera camera = view::camera_on({0, 0, 0, {}}, lattice);
    const view::Sampling sampling{.level_of_detail = true};
    EXPECT_GE(view::factorise(camera, {50, 50}, lattice, sampling).level(), 2);
    const view::TransferFunction tf{.opacity_pins = {view::Flat{0.2}}, .colour_pins = {{0, {1, 1, 1}}}};
    for (const std::int64_t last : {102, 105, 109, 200}) {
        const Box box{{0, 0, 101}, {256, 256, last}};
        const auto drawn = draw(volume, {1, 1, 1}, tf, camera, {50, 50}, sampling, box);
        EXPECT_LE(4 << drawn.level, std::max<std::int64_t>(last - 101, 4));
        const double expected = 1 - std::pow(0.8, static_cast<double>(last - 101));
        EXPECT_NEAR(drawn.picture.at(25, 25).a, expected, 0.01 * expected);
    }
}

TEST(Crop, IsValidated) {
    const Index3 small{10, 20, 30};
    EXPECT_TRUE(view::validate_crop({{0, 0, 0}, {9, 19, 29}}, small));
    EXPECT_TRUE(view::validate_crop({{4, 4, 4}, {5, 5, 5}}, small));
    for (const Box& bad :
         {Box{{-1, 0, 0}, {9, 19, 29}}, Box{{0, 0, 0}, {10, 19, 29}}, Box{{5, 0, 0}, {5, 19, 29}},
          Box{{0, 12, 0}, {9, 11, 29}}, Box{{0, 0, 0}, {9, 19, std::numeric_limits<std::int64_t>::max()}}}) {
        EXPECT_FALSE(view::validate_crop(bad, small)) << volume::to_string(bad);
    }
    EXPECT_EQ(view::widened_to_nodes({{3, 4, 5}, {4, 9, 29}}, 2, small), (Box{{0, 4, 4}, {4, 12, 29}}));
}

}  // namespace
}  // namespace shearwater::test
