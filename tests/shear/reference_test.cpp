// The engine's pictures beside those of the independent ray caster.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>

#include "tests/support/reference_raycaster.h"
#include "tests/support/reference_views.h"

namespace shearwater::test {
namespace {

using image::Image;
using image::RgbaF;
using view::Camera;
using view::ImageSize;
using view::Lattice;
using view::Projection;
using view::Vec3;

TEST(SmoothCube, IsTheRayCastersPicture) {
    Scene scene{.cube = smooth_cube({61, 47, 53})};
    const auto views = views_from(scene.lattice(), 30, 20);
    for (const NamedView& view : std::span(views).first(3)) {
        const Match found = match(scene, view.camera, {512, 512});
        EXPECT_GE(found.at_high, 52) << view.name;
        EXPECT_GE(found.at_normal, 52) << view.name;
    }
}

// Seen along an axis, a cube's outline is a step from nothing to its whole depth.
TEST(SmoothCube, EndsWhereItEnds) {
    Scene scene{.cube = smooth_cube({61, 47, 53}, 2)};
    const Camera camera = view::camera_on({0, 0}, scene.lattice(), Projection::parallel);
    for (const ImageSize& size : {ImageSize{200, 200}, {201, 203}, {180, 170}}) {
        EXPECT_GE(match(scene, camera, size).at_normal, 55) << size.width;
    }
}

TEST(SmoothCube, IsSoFromEveryDirection) {
    Scene scene{.cube = smooth_cube({40, 61, 23}, 7)};
    for (const NamedView& view : all_views(scene.lattice())) {
        // Walls that are seen under a degree or so are narrower than a pixel of so small a picture.
        EXPECT_GE(match(scene, view.camera, {97, 80}).at_normal, 40) << view.name;
    }
}

TEST(SmoothCube, IsSoAtAnySpacing) {
    for (const Vec3& spacing : {Vec3(3, 1, 0.5), Vec3(0.2, 1, 0.7)}) {
        Scene scene{.cube = smooth_cube({40, 61, 23}, 3), .spacing = spacing};
        for (const NamedView& view : views_from(scene.lattice(), 200, -50)) {
            EXPECT_GE(match(scene, view.camera, {131, 110}).at_normal, 44) << view.name;
        }
    }
}

TEST(SmoothCube, IsSoIn16Bits) {
    Scene scene{.cube = smooth_cube({40, 61, 23}, 4), .mapping = {.bits = 16}};
    for (const NamedView& view : views_from(scene.lattice(), 60, -10)) {
        EXPECT_GE(match(scene, view.camera, {131, 110}).at_normal, 46) << view.name;
    }
}

// Thin and dense: the picture is dark but for a shell.
TEST(SmoothCube, IsSoUnderAHat) {
    Scene scene{.cube = smooth_cube({61, 47, 53}, 5)};
    scene.tf.opacity_pins = {view::Hat{0.6, 0.05, 0.3, 0.7}, view::Blank{0.3, 0.4}, view::Flat{0.002}};
    for (const NamedView& view : views_from(scene.lattice(), 120, 40)) {
        EXPECT_GE(match(scene, view.camera, {200, 200}).at_normal, 40) << view.name;
    }
}

// A blank ball in the middle, and blank voxels strewn about.
TEST(BlankVoxels, AreTransparentAndDarkenNothingBeside) {
    Scene scene{.cube = smooth_cube({61, 47, 53}, 6)};
    for (std::int64_t z = 0; z < 53; ++z) {
        for (std::int64_t y = 0; y < 47; ++y) {
            for (std::int64_t x = 0; x < 61; ++x) {
                const bool ball = std::hypot(x - 30, y - 20, z - 25) < 12;
                if (ball || (x * 7 + y * 13 + z * 29) % 97 == 0) {
                    scene.cube.at(x, y, z) = std::numeric_limits<float>::quiet_NaN();
                }
            }
        }
    }
    for (const NamedView& view : views_from(scene.lattice(), 30, 20)) {
        EXPECT_GE(match(scene, view.camera, {200, 200}).at_normal, 40) << view.name;
    }
}

// A wide view has several faces; a seam between two would show as a difference along their diagonal.
TEST(WideView, HasNoSeamBetweenFaces) {
    base::Workers workers;
    FloatCube cube = smooth_cube({50, 50, 50}, 8);
    const Lattice lattice{cube.n(), {1, 1, 1}};
    const auto volume = bricks_of(cube, workers);
    const ImageSize size{240, 240};
    for (const double azimuth : {45.0, 20.0, 160.0}) {
        const Camera camera =
            view::camera_on({azimuth, 35, 6, {3, 2, -4}}, lattice, Projection::perspective, 120);
        ASSERT_GE(view::factorise(camera, size, lattice, {1}).faces.size(), 3U);
        const auto truth = cast_rays(cube, {1, 1, 1}, {}, ramp_to(0.15), camera, size, workers);
        const auto picture = picture_of(volume, lattice, ramp_to(0.15), camera, size, workers);
        for (std::size_t i = 0; i < truth.pixels().size(); ++i) {
            const RgbaF& p = picture.pixels()[i];
            const RgbaF& q = truth.pixels()[i];
            ASSERT_NEAR(p.a, q.a, 0.01) << i % 240 << ", " << i / 240;
            ASSERT_NEAR(p.r, q.r, 0.01) << i % 240 << ", " << i / 240;
        }
    }
}

// What is behind the eye is never seen: an opaque half behind changes nothing.
TEST(Eye, SeesNothingBehindIt) {
    base::Workers workers;
    const Lattice lattice{{40, 40, 40}, {1, 1, 1}};
    FloatCube cube(lattice.n, [](double, double, double z) { return z > 21 ? 1.0F : 0.0F; });
    const auto volume = bricks_of(cube, workers);
    const view::TransferFunction tf{.opacity_pins = {view::Ramp{0.5, 0, 1, 0.9}},
                                    .colour_pins = {{0, {1, 1, 1}}}};
    Camera camera;
    camera.eye = lattice.world_from_voxel({20, 20, 20.5});
    camera.target = lattice.world_from_voxel({20, 20, 0});
    camera.fov = 90;
    const auto picture = picture_of(volume, lattice, tf, camera, {100, 100}, workers);
    for (const RgbaF& pixel : picture.pixels()) {
        ASSERT_EQ(pixel.a, 0);
    }
}

TEST(PermutedAxes, GiveTheSamePicture) {
    base::Workers workers;
    FloatCube cube = noise_cube({45, 33, 38});
    const Vec3 spacing{1, 1.5, 0.8};
    const auto volume = bricks_of(cube, workers);
    const Lattice lattice{cube.n(), spacing};
    const ImageSize size{120, 110};
    // An even permutation is a rotation; an odd one mirrors, which negating one axis would undo: the
    // camera's right is then its left, so pictures are compared mirrored.
    for (const std::array<int, 3>& from : {std::array{1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}}) {
        const bool mirrored = (from[0] + 1) % 3 != from[1];
        FloatCube turned = permuted(cube, from);
        const auto turned_volume = bricks_of(turned, workers);
        const auto turn = [&](const Vec3& p) { return Vec3(p[from[0]], p[from[1]], p[from[2]]); };
        const Lattice turned_lattice{turned.n(), turn(spacing)};
        for (const NamedView& view : views_from(lattice, 30, 20)) {
            Camera camera = view.camera;
            const auto original = in_8_bits(picture_of(volume, lattice, ramp_to(0.3), camera, size, workers));
            camera.eye = turn(camera.eye);
            camera.target = turn(camera.target);
            camera.up = turn(camera.up);
            auto picture =
                in_8_bits(picture_of(turned_volume, turned_lattice, ramp_to(0.3), camera, size, workers));
            for (int y = 0; mirrored && y < size.height; ++y) {
                std::reverse(picture.row(y).begin(), picture.row(y).end());
            }
            EXPECT_LE(largest_difference(original, picture), 1) << view.name;
        }
    }
}

}  // namespace
}  // namespace shearwater::test
