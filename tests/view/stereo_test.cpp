// Two eyes: one projection plane, no parallax up and down, and as much across as the formula says.

#include "common/view/stereo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/view/project.h"

namespace shearwater::view {
namespace {

const Lattice paired_lattice{{65, 49, 33}, {1, 1.5, 0.75}};
const ImageSize size{301, 200};

std::vector<Camera> pair_cameras() {
    std::vector<Camera> all;
    for (const Projection projection : {Projection::perspective, Projection::parallel}) {
        for (const double azimuth : {0.0, 33.0, 200.0}) {
            all.push_back(camera_on({azimuth, 25, 140, {3, -2, 5}}, paired_lattice, projection, 40));
        }
    }
    return all;
}

Vec3 point_at(const Camera& camera, double across, double up, double depth) {
    const Axes axes = axes_of(camera);
    return camera.eye + across * axes.right + up * axes.up + depth * axes.forward;
}

TEST(Project, InvertsTheRays) {
    for (Camera camera : pair_cameras()) {
        camera.slant = {0.3, -0.2};
        const Rays rays = rays_of(camera, size);
        for (const Vec2 pixel : {Vec2(0, 0), Vec2(17.5, 150.25), Vec2(301, 200)}) {
            for (const double t : {1.0, 37.0, 400.0}) {
                const Vec3 point = rays.origin_at(pixel.x, pixel.y) + t * rays.direction_at(pixel.x, pixel.y);
                const Projected there = project(camera, size, point);
                EXPECT_NEAR(there.at.x, pixel.x, 1e-9);
                EXPECT_NEAR(there.at.y, pixel.y, 1e-9);
                EXPECT_NEAR(there.depth, t, 1e-9);
                EXPECT_TRUE(there.seen_by(camera));
            }
        }
        const bool perspective = camera.projection == Projection::perspective;
        EXPECT_EQ(project(camera, size, point_at(camera, 0, 0, -5)).seen_by(camera), !perspective);
    }
}

TEST(Stereo, HasAParallaxByTheFormulaAndNoneUpAndDown) {
    for (const Camera& camera : pair_cameras()) {
        for (const StereoSettings& settings : {StereoSettings{}, StereoSettings{6, 0, false},
                                               StereoSettings{9, 80, false}, StereoSettings{5, 200, true}}) {
            const auto eyes = eyes_of(camera, settings);
            for (const double depth : {20.0, 80.0, 140.0, 200.0, 1000.0}) {
                for (const double across : {-30.0, 0.0, 12.0}) {
                    const Vec3 point = point_at(camera, across, 7, depth);
                    const Projected first = project(eyes[0], size, point);
                    const Projected second = project(eyes[1], size, point);
                    EXPECT_NEAR(second.at.x - first.at.x, parallax(camera, settings, depth, size), 1e-8);
                    EXPECT_NEAR(second.at.y, first.at.y, 1e-8);
                }
            }
        }
    }
}

TEST(Stereo, CrossesBeforeThePlaneAndNotBehindIt) {
    for (const Camera& camera : pair_cameras()) {
        const StereoSettings settings{8, 100, false};
        EXPECT_LT(parallax(camera, settings, 50, size), -1);
        EXPECT_NEAR(parallax(camera, settings, 100, size), 0, 1e-12);
        EXPECT_GT(parallax(camera, settings, 200, size), 1);
        EXPECT_GT(parallax(camera, {8, 100, true}, 50, size), 1);
    }
}

// The eyes are not turned towards each other: both see the plane in the same rectangle.
TEST(Stereo, SharesOneProjectionPlane) {
    for (const Camera& camera : pair_cameras()) {
        const StereoSettings settings{11, 90, false};
        const auto eyes = eyes_of(camera, settings);
        const Axes axes = axes_of(camera);
        for (const Camera& eye : eyes) {
            EXPECT_NEAR(glm::dot(axes_of(eye).forward, axes.forward), 1, 1e-12);
            EXPECT_NEAR(glm::dot(axes_of(eye).right, axes.right), 1, 1e-12);
            for (const double x : {-1.0, 1.0}) {
                for (const double y : {-1.0, 1.0}) {
                    const double half = height_at(camera, 90) / 2;
                    const Vec3 corner = point_at(camera, x * half * size.width / size.height, y * half, 90);
                    const Projected at = project(eye, size, corner);
                    EXPECT_NEAR(at.at.x, x < 0 ? 0 : size.width, 1e-8);
                    EXPECT_NEAR(at.at.y, y > 0 ? 0 : size.height, 1e-8);
                }
            }
        }
        EXPECT_NEAR(glm::length(eyes[1].eye - eyes[0].eye - 11.0 * axes.right), 0, 1e-9);
        EXPECT_NEAR(glm::length(eyes[1].eye + eyes[0].eye - 2.0 * camera.eye), 0, 1e-9);
    }
}

TEST(Stereo, HasDefaultsOfTheTarget) {
    const Camera camera = camera_on({10, 20, 150, {}}, paired_lattice);
    EXPECT_NEAR(resolved({}, camera).convergence, 150, 1e-9);
    EXPECT_NEAR(resolved({}, camera).separation, 5, 1e-9);
    EXPECT_NEAR(resolved({0, 60, false}, camera).separation, 2, 1e-9);
    EXPECT_EQ(resolved({3, 70, true}, camera), (StereoSettings{3, 70, true}));
}

TEST(Stereo, SwapsTheEyes) {
    const Camera camera = camera_on({}, paired_lattice);
    const auto eyes = eyes_of(camera, {4, 0, false}), swapped = eyes_of(camera, {4, 0, true});
    EXPECT_EQ(eyes[0], swapped[1]);
    EXPECT_EQ(eyes[1], swapped[0]);
    EXPECT_LT(glm::dot(eyes[0].eye - eyes[1].eye, axes_of(camera).right), 0);
}

TEST(Stereo, RefusesWhatCannotBeSeen) {
    const Camera camera = camera_on({0, 0, 100, {}}, paired_lattice);
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(validate(StereoSettings{}, camera, size));
    EXPECT_TRUE(validate(StereoSettings{1000, 0, false}, camera, size));
    for (const StereoSettings& bad :
         {StereoSettings{-1, 0, false}, StereoSettings{0, -1, false}, StereoSettings{std::nan(""), 0, false},
          StereoSettings{0, std::nan(""), false}, StereoSettings{infinity, 0, false},
          StereoSettings{0, infinity, false}, StereoSettings{2001, 100, false},
          StereoSettings{1e300, 1e-300, false}, StereoSettings{1, 1e-300, false}}) {
        EXPECT_FALSE(validate(bad, camera, size)) << bad.separation << " " << bad.convergence;
    }
    EXPECT_TRUE(validate(StereoSettings{}, camera, {8192, 2048}));
    EXPECT_FALSE(validate(StereoSettings{}, camera, {8192, 2049}));
}

TEST(Slant, IsValidatedLikeAllElse) {
    Camera camera = camera_on({}, paired_lattice);
    camera.slant = {6, 8};
    EXPECT_TRUE(validate(camera, size));
    for (const Vec2 bad : {Vec2(6, 8.1), Vec2(std::nan(""), 0), Vec2(0, HUGE_VAL)}) {
        camera.slant = bad;
        EXPECT_FALSE(validate(camera, size));
    }
}

}  // namespace
}  // namespace shearwater::view
