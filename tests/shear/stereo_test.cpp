// Two eyes' pictures, as they are rendered: what is small and bright lies where the formula says.

#include <gtest/gtest.h>

#include <cmath>

#include "common/view/project.h"
#include "common/view/stereo.h"
#include "tests/support/reference_raycaster.h"
#include "tests/support/reference_views.h"

namespace shearwater::test {
namespace {

using view::Projection;
using view::Vec2;
using view::Vec3;

const volume::Index3 n{60, 60, 60};
const view::Lattice lattice{n, {1, 1, 1}};
const view::ImageSize size{160, 120};

FloatCube blob_at(const Vec3& voxel) {
    return FloatCube(n, [&](double x, double y, double z) {
        const Vec3 away = Vec3(x, y, z) - voxel;
        return static_cast<float>(std::exp(-glm::dot(away, away) / 8));
    });
}

Vec2 middle_of_light(const image::Image<image::RgbaF>& picture) {
    Vec2 sum(0);
    double light = 0;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            const double a = static_cast<double>(picture.at(x, y).a);
            sum += a * Vec2(x + 0.5, y + 0.5);
            light += a;
        }
    }
    EXPECT_GT(light, 1);
    return sum / light;
}

TEST(StereoPictures, HaveTheParallaxOfTheFormula) {
    base::Workers workers;
    for (const Projection projection : {Projection::perspective, Projection::parallel}) {
        const view::Camera camera = view::camera_on({30, 20, 150, {}}, lattice, projection, 45, 100);
        const view::Axes axes = view::axes_of(camera);
        const view::StereoSettings settings{15, 0, false};
        const auto eyes = view::eyes_of(camera, settings);
        // Before the plane of convergence, on it, and behind it.
        for (const double behind : {-22.0, 0.0, 22.0}) {
            const Vec3 world = behind * axes.forward + 4.0 * axes.up;
            FloatCube cube = blob_at(lattice.voxel_from_world(world));
            const auto volume = bricks_of(cube, workers);
            std::array<Vec2, 2> at;
            for (std::size_t eye = 0; eye < 2; ++eye) {
                const auto picture = picture_of(volume, lattice, ramp_to(0.3), eyes[eye], size, workers);
                at[eye] = middle_of_light(picture);
                const Vec2 expected = view::project(eyes[eye], size, world).at;
                EXPECT_NEAR(at[eye].x, expected.x, 0.5);
                EXPECT_NEAR(at[eye].y, expected.y, 0.5);
            }
            const double parallax = view::parallax(camera, settings, 150 + behind, size);
            EXPECT_NEAR(at[1].x - at[0].x, parallax, 0.5) << behind;
            EXPECT_NEAR(at[1].y - at[0].y, 0, 0.2) << behind;
            EXPECT_EQ(parallax < -1.5, behind < 0) << parallax;
            EXPECT_EQ(parallax > 1.5, behind > 0) << parallax;
        }
    }
}

// Off the axis the picture is as right as on it: beside the ray caster's, that knows no faces.
TEST(StereoPictures, AreTheRayCasters) {
    base::Workers workers;
    FloatCube cube = smooth_cube(n, 9);
    const auto volume = bricks_of(cube, workers);
    const auto tf = ramp_to(0.15);
    for (const Projection projection : {Projection::perspective, Projection::parallel}) {
        for (const double azimuth : {0.0, 40.0}) {
            view::Camera camera = view::camera_on({azimuth, 25, 0, {}}, lattice, projection, 50);
            for (const Vec2 slant : {Vec2(0.3, 0), Vec2(-0.2, 0.25)}) {
                camera.slant = slant;
                camera.eye -= slant.x * 100.0 * view::axes_of(camera).right;
                camera.target -= slant.x * 100.0 * view::axes_of(camera).right;
                const auto picture = picture_of(volume, lattice, tf, camera, size, workers,
                                                view::sampling(view::Quality::high));
                const auto truth = cast_rays(cube, {1, 1, 1}, {}, tf, camera, size, workers, 0.25);
                EXPECT_GE(psnr(in_8_bits(picture), in_8_bits(truth)), 45);
            }
        }
    }
}

// What both eyes of a frame are drawn on is one level, that of the eye that wants the finer one.
TEST(StereoPictures, AreOfOneLevel) {
    const view::Lattice large{{400, 400, 400}, {1, 1, 1}};
    const view::Sampling sampling{.level_of_detail = true};
    int apart = 0;
    for (double distance = 300; distance < 2500; distance *= 1.01) {
        const view::Camera camera = view::camera_on({60, 10, distance, {}}, large);
        const auto eyes = view::eyes_of(camera, {distance / 3, 0, false});
        const auto each = view::factorise(eyes, {200, 200}, large, sampling);
        const int left = view::factorise(eyes[0], {200, 200}, large, sampling).level();
        const int right = view::factorise(eyes[1], {200, 200}, large, sampling).level();
        ASSERT_EQ(each.size(), 2U);
        EXPECT_EQ(each[0].level(), std::min(left, right));
        EXPECT_EQ(each[1].level(), std::min(left, right));
        apart += left != right ? 1 : 0;
    }
    EXPECT_GT(apart, 0);
}

}  // namespace
}  // namespace shearwater::test
