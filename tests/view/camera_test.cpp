#include "common/view/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace shearwater::view {
namespace {

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

const Lattice tall_lattice{{11, 21, 31}, {1, 2, 0.5}};

TEST(Lattice, PutsTheMiddleOfTheCubeAtTheOrigin) {
    expect_near(tall_lattice.world_from_voxel({5, 10, 15}), {0, 0, 0});
    expect_near(tall_lattice.world_from_voxel({0, 0, 0}), {-5, -20, -7.5});
    expect_near(tall_lattice.voxel_from_world(tall_lattice.world_from_voxel({1.5, 2, 30})), {1.5, 2, 30});
    EXPECT_DOUBLE_EQ(tall_lattice.diagonal(), std::sqrt(10.0 * 10 + 40 * 40 + 15 * 15));
}

TEST(CameraOn, FollowsTheOrbitFormula) {
    const double az = 30 * M_PI / 180;
    const double el = 20 * M_PI / 180;
    const Camera camera = camera_on({30, 20, 10, {1, 2, 3}}, tall_lattice);
    expect_near(camera.eye, Vec3(1, 2, 3) + 10.0 * Vec3(std::sin(az) * std::cos(el), std::sin(el),
                                                        std::cos(az) * std::cos(el)));
    expect_near(camera.up, {0, 1, 0});
}

TEST(CameraOn, StandsFarEnoughToSeeTheWholeCube) {
    const Camera camera = camera_on({}, tall_lattice);
    EXPECT_NEAR(glm::length(camera.eye), tall_lattice.diagonal() / 2 / std::sin(15 * M_PI / 180), 1e-9);
    EXPECT_DOUBLE_EQ(camera_on({}, tall_lattice, Projection::parallel).height, tall_lattice.diagonal());
}

TEST(CameraOn, SeesOverThePoles) {
    for (const double elevation : {90.0, -90.0}) {
        const Camera pole = camera_on({40, elevation, 10}, tall_lattice);
        ASSERT_TRUE(validate(pole, {64, 64}).has_value());
        const Camera near = camera_on({40, elevation * (1 - 1e-5), 10}, tall_lattice);
        expect_near(rays_of(pole, {64, 64}).dir_x, rays_of(near, {64, 64}).dir_x, 1e-4);
        expect_near(rays_of(pole, {64, 64}).dir_y, rays_of(near, {64, 64}).dir_y, 1e-4);
    }
}

TEST(CameraOn, RollLeansTheCameraToItsRight) {
    for (const double elevation : {20.0, 90.0}) {
        const Orbit upright{40, elevation, 10, {1, 2, 3}};
        Orbit leaning = upright;
        leaning.roll = 90;
        const Rays before = rays_of(camera_on(upright, tall_lattice), {64, 64});
        const Rays after = rays_of(camera_on(leaning, tall_lattice), {64, 64});
        expect_near(after.dir_y, -before.dir_x);  // what was to the right is on top
        expect_near(after.dir_x, before.dir_y);
        leaning.roll = 180;
        expect_near(rays_of(camera_on(leaning, tall_lattice), {64, 64}).dir_x, -before.dir_x);
        leaning.roll = 360;
        expect_near(rays_of(camera_on(leaning, tall_lattice), {64, 64}).dir_x, before.dir_x);
    }
}

TEST(PictureAxes, AreThoseOfTheRays) {
    for (const double roll : {0.0, 33.0, -170.0}) {
        const Orbit orbit{70, -35, 10, {1, 2, 3}, roll};
        const Rays rays = rays_of(camera_on(orbit, tall_lattice), {64, 64});
        const PictureAxes axes = picture_axes(orbit);
        expect_near(glm::normalize(rays.dir_x), axes.right);
        expect_near(glm::normalize(rays.dir_y), -axes.up);
        expect_near(glm::normalize(rays.direction_at(32, 32)), -axes.back);
    }
}

TEST(RaysOf, PutsXToTheRightAndRow0OnTop) {
    Camera camera;
    camera.eye = {0, 0, 5};
    camera.fov = 90;
    const Rays rays = rays_of(camera, {200, 100});
    expect_near(glm::normalize(rays.direction_at(100, 50)), {0, 0, -1});
    expect_near(rays.direction_at(100, 0) / rays.direction_at(100, 0).z, {0, -1, 1});
    EXPECT_GT(rays.direction_at(100, 0).y, 0);
    EXPECT_GT(rays.direction_at(200, 50).x, 0);
    expect_near(rays.origin_at(17, 3), {0, 0, 5});
}

TEST(RaysOf, GivesAParallelPictureItsHeight) {
    Camera camera;
    camera.eye = {0, 0, 5};
    camera.projection = Projection::parallel;
    camera.height = 8;
    const Rays rays = rays_of(camera, {200, 100});
    expect_near(rays.direction_at(3, 4), {0, 0, -1});
    expect_near(rays.origin_at(100, 50), {0, 0, 5});
    expect_near(rays.origin_at(0, 0), {-8, 4, 5});
    expect_near(rays.origin_at(200, 100), {8, -4, 5});
}

TEST(RaysInVoxelSpace, MeetTheSamePoints) {
    const Rays world = rays_of(camera_on({30, 20}, tall_lattice), {50, 50});
    const Rays voxel = in_voxel_space(world, tall_lattice);
    const Vec3 point = world.origin_at(3, 9) + 2.5 * world.direction_at(3, 9);
    expect_near(voxel.origin_at(3, 9) + 2.5 * voxel.direction_at(3, 9), tall_lattice.voxel_from_world(point),
                1e-9);
}

TEST(ValidateCamera, RefusesWhatCannotBeDrawn) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto fails = [](const auto& spoil, const ImageSize& size = {64, 64}) {
        Camera camera;
        spoil(camera);
        return validate(camera, size).has_error();
    };
    EXPECT_FALSE(fails([](Camera&) {}));
    EXPECT_TRUE(fails([&](Camera& c) { c.eye.x = nan; }));
    EXPECT_TRUE(fails([&](Camera& c) { c.target.y = HUGE_VAL; }));
    EXPECT_TRUE(fails([&](Camera& c) { c.up.z = nan; }));
    EXPECT_TRUE(fails([](Camera& c) { c.eye = c.target; }));
    EXPECT_TRUE(fails([](Camera& c) { c.eye = {1e200, 0, 0}; }));
    EXPECT_TRUE(fails([](Camera& c) { c.up = {0, 0, -3}; }));
    EXPECT_TRUE(fails([](Camera& c) { c.up = {0, 0, 0}; }));
    for (const double fov : {0.0, 180.0, -1.0, nan}) {
        EXPECT_TRUE(fails([&](Camera& c) { c.fov = fov; })) << fov;
    }
    for (const double height : {0.0, -1.0, nan, HUGE_VAL}) {
        EXPECT_TRUE(fails([&](Camera& c) { c.projection = Projection::parallel, c.height = height; }))
            << height;
    }
    for (const ImageSize& size : {ImageSize{0, 5}, {5, -1}, {8193, 1}, {8192, 8192}}) {
        EXPECT_TRUE(fails([](Camera&) {}, size)) << size.width;
    }
    EXPECT_FALSE(fails([](Camera&) {}, {8192, 4096}));
}

}  // namespace
}  // namespace shearwater::view
