#include "client/model/viewpoint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace shearwater::model {
namespace {

using view::ImageSize;
using view::Projection;

const view::Lattice flat_lattice{.n = {64, 32, 16}, .spacing = {1, 1, 2}};
constexpr ImageSize size{640, 480};

// Where a world point lies in the picture, by the definition of the camera.
view::Vec2 project(const view::Camera& camera, const view::Vec3& point) {
    const view::Vec3 d = glm::normalize(camera.target - camera.eye);
    const view::Vec3 right = glm::normalize(glm::cross(d, camera.up));
    const view::Vec3 up = glm::cross(right, d);
    const view::Vec3 to = point - camera.eye;
    const double half = camera.projection == Projection::parallel
                            ? camera.height / 2
                            : glm::dot(to, d) * std::tan(camera.fov / 2 * std::numbers::pi / 180);
    return {size.width / 2.0 + glm::dot(to, right) / half * size.height / 2,
            size.height / 2.0 - glm::dot(to, up) / half * size.height / 2};
}

// The point of the target's plane that is seen at a pixel.
view::Vec3 point_at(const view::Camera& camera, const view::Vec2& pixel) {
    const view::Vec3 d = glm::normalize(camera.target - camera.eye);
    const view::Vec3 right = glm::normalize(glm::cross(d, camera.up));
    const view::Vec3 up = glm::cross(right, d);
    const double half =
        camera.projection == Projection::parallel
            ? camera.height / 2
            : glm::distance(camera.eye, camera.target) * std::tan(camera.fov / 2 * std::numbers::pi / 180);
    return camera.target + (pixel.x - size.width / 2.0) / (size.height / 2.0) * half * right -
           (pixel.y - size.height / 2.0) / (size.height / 2.0) * half * up;
}

constexpr Projection both[] = {Projection::perspective, Projection::parallel};

TEST(Viewpoint, BeginsWithTheDesignsDefaults) {
    for (const Projection projection : both) {
        Viewpoint viewpoint;
        viewpoint.projection = projection;
        const auto mine = camera(viewpoint, flat_lattice);
        const auto designs = view::camera_on(view::Orbit{}, flat_lattice, projection, 30, 0);
        EXPECT_NEAR(glm::distance(mine.eye, designs.eye), 0, 1e-9);
        EXPECT_NEAR(mine.height, flat_lattice.diagonal(), 1e-9);
        EXPECT_TRUE(view::validate(mine, size));
    }
}

TEST(Viewpoint, ADragOverTheHeightTurnsHalfACircle) {
    Viewpoint viewpoint;
    drag_orbit(viewpoint, 480, 0, size);
    EXPECT_NEAR(viewpoint.orbit.azimuth, -150, 1e-9);
    drag_orbit(viewpoint, 0, 48, size);
    EXPECT_NEAR(viewpoint.orbit.elevation, 38, 1e-9);
    drag_orbit(viewpoint, 0, 10000, size);
    EXPECT_LT(viewpoint.orbit.elevation, 90);
    EXPECT_TRUE(view::validate(camera(viewpoint, flat_lattice), size));
    drag_orbit(viewpoint, 0, -10000, size);
    EXPECT_GT(viewpoint.orbit.elevation, -90);
}

// Dragging to the right moves what is in front to the right, downwards moves it down.
TEST(Viewpoint, WhatIsInFrontFollowsTheDrag) {
    Viewpoint viewpoint;
    const auto before = camera(viewpoint, flat_lattice);
    const view::Vec3 front = before.target + 0.2 * (before.eye - before.target);
    drag_orbit(viewpoint, 30, 20, size);
    const auto moved = project(camera(viewpoint, flat_lattice), front);
    EXPECT_GT(moved.x, size.width / 2.0 + 1);
    EXPECT_GT(moved.y, size.height / 2.0 + 1);
}

TEST(Viewpoint, PanMovesTheTargetWithTheMouse) {
    for (const Projection projection : both) {
        Viewpoint viewpoint;
        viewpoint.projection = projection;
        const view::Vec3 before = camera(viewpoint, flat_lattice).target;
        pan(viewpoint, 37, -21, size, flat_lattice);
        const auto seen = project(camera(viewpoint, flat_lattice), before);
        EXPECT_NEAR(seen.x, size.width / 2.0 + 37, 1e-6);
        EXPECT_NEAR(seen.y, size.height / 2.0 - 21, 1e-6);
    }
}

TEST(Viewpoint, ZoomKeepsThePointUnderTheCursor) {
    for (const Projection projection : both) {
        Viewpoint viewpoint;
        viewpoint.projection = projection;
        const view::Vec2 cursor{500, 100};
        const view::Vec3 point = point_at(camera(viewpoint, flat_lattice), cursor);
        const double before = camera(viewpoint, flat_lattice).height;
        zoom(viewpoint, 0.6, cursor.x, cursor.y, size, flat_lattice);
        const auto after = camera(viewpoint, flat_lattice);
        const auto seen = project(after, point);
        EXPECT_NEAR(seen.x, cursor.x, 1e-6);
        EXPECT_NEAR(seen.y, cursor.y, 1e-6);
        if (projection == Projection::parallel) {
            EXPECT_NEAR(after.height, before * 0.6, 1e-9);
        }
    }
}

TEST(Viewpoint, NoAmountOfMovingMakesTheCameraInvalid) {
    for (const Projection projection : both) {
        Viewpoint viewpoint;
        viewpoint.projection = projection;
        for (int i = 0; i < 300; ++i) {
            zoom(viewpoint, 0.8, 640, 0, size, flat_lattice);
            pan(viewpoint, 1000, 1000, size, flat_lattice);
        }
        EXPECT_TRUE(view::validate(camera(viewpoint, flat_lattice), size));
        for (int i = 0; i < 300; ++i) {
            zoom(viewpoint, 1.25, 640, 0, size, flat_lattice);
            pan(viewpoint, -1000, 500, size, flat_lattice);
        }
        EXPECT_TRUE(view::validate(camera(viewpoint, flat_lattice), size));
        set_fov(viewpoint, std::numeric_limits<double>::quiet_NaN(), flat_lattice);
        EXPECT_TRUE(view::validate(camera(viewpoint, flat_lattice), size));
    }
}

TEST(Viewpoint, TheFieldOfViewKeepsTheScale) {
    Viewpoint viewpoint;
    zoom(viewpoint, 0.7, 320, 240, size, flat_lattice);
    const double height = camera(viewpoint, flat_lattice).height;
    set_fov(viewpoint, 90, flat_lattice);
    EXPECT_EQ(viewpoint.fov, 90);
    EXPECT_NEAR(camera(viewpoint, flat_lattice).height, height, 1e-9);
    set_fov(viewpoint, 1000, flat_lattice);
    EXPECT_EQ(viewpoint.fov, max_fov);
}

// Whatever the roll, what is in front goes where the mouse goes.
TEST(Viewpoint, WhatIsInFrontFollowsTheDragWhenRolled) {
    for (const double lean : {0.0, 40.0, 135.0, -90.0}) {
        Viewpoint viewpoint;
        roll(viewpoint, lean);
        EXPECT_EQ(viewpoint.orbit.roll, lean);
        const auto before = camera(viewpoint, flat_lattice);
        const view::Vec3 front = before.target + 0.2 * (before.eye - before.target);
        Viewpoint turned = viewpoint;
        drag_orbit(turned, 8, 5, size);
        const auto moved = project(camera(turned, flat_lattice), front);
        EXPECT_GT(moved.x, size.width / 2.0 + 1) << lean;
        EXPECT_GT(moved.y, size.height / 2.0 + 1) << lean;

        Viewpoint panned = viewpoint;
        pan(panned, 37, -21, size, flat_lattice);
        const auto seen = project(camera(panned, flat_lattice), before.target);
        EXPECT_NEAR(seen.x, size.width / 2.0 + 37, 1e-6) << lean;
        EXPECT_NEAR(seen.y, size.height / 2.0 - 21, 1e-6) << lean;
    }
}

TEST(Viewpoint, ARollByTheMouseTurnsThePictureWithIt) {
    Viewpoint viewpoint;
    const view::Vec2 from{size.width / 2.0 + 100, size.height / 2.0};
    const view::Vec3 point = point_at(camera(viewpoint, flat_lattice), from);
    drag_roll(viewpoint, size.width / 2.0, size.height / 2.0 + 100, -100, 100, size);
    const auto seen = project(camera(viewpoint, flat_lattice), point);
    EXPECT_NEAR(seen.x, size.width / 2.0, 1e-6);
    EXPECT_NEAR(seen.y, size.height / 2.0 + 100, 1e-6);
    const Viewpoint before = viewpoint;
    drag_roll(viewpoint, size.width / 2.0, size.height / 2.0, 1, 1, size);
    EXPECT_EQ(viewpoint, before) << "at the middle there is no direction";
    roll(viewpoint, 1000);
    EXPECT_LE(std::abs(viewpoint.orbit.roll), 180);
}

TEST(Viewpoint, LooksFromSixSides) {
    const view::Vec3 directions[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int side = 0; side < 6; ++side) {
        Viewpoint viewpoint;
        roll(viewpoint, 33);
        viewpoint.orbit.target = {1, 2, 3};
        look_from(viewpoint, static_cast<Side>(side));
        const auto from = camera(viewpoint, flat_lattice);
        EXPECT_NEAR(glm::distance(glm::normalize(from.eye - from.target), directions[side]), 0, 1e-9);
        EXPECT_TRUE(view::validate(from, size));
        EXPECT_EQ(viewpoint.orbit.roll, 0);
        drag_orbit(viewpoint, 3, 1, size);
        EXPECT_TRUE(view::validate(camera(viewpoint, flat_lattice), size));
    }
}

// All of the cube is in the picture, and it could hardly be larger.
TEST(Viewpoint, FitsTheWholeCubeIn) {
    for (const Projection projection : both) {
        for (const ImageSize& picture : {ImageSize{640, 480}, ImageSize{300, 900}, ImageSize{900, 200}}) {
            for (const double azimuth : {0.0, 50.0, 170.0}) {
                Viewpoint viewpoint{
                    .orbit = {azimuth, 35, 3, {9, 9, 9}, 20}, .projection = projection, .fov = 50};
                fit(viewpoint, picture, flat_lattice);
                EXPECT_EQ(viewpoint.orbit.azimuth, azimuth);
                EXPECT_EQ(viewpoint.orbit.roll, 20);
                const auto seen_by = camera(viewpoint, flat_lattice);
                double most = 0;
                for (int corner = 0; corner < 8; ++corner) {
                    const view::Vec3 voxel{corner % 2 == 0 ? 0 : 63, corner / 2 % 2 == 0 ? 0 : 31,
                                           corner / 4 == 0 ? 0 : 15};
                    const view::Rays rays = view::rays_of(seen_by, picture);
                    const view::PictureAxes axes = view::picture_axes(viewpoint.orbit);
                    const view::Vec3 to = flat_lattice.world_from_voxel(voxel) - seen_by.eye;
                    const double depth = projection == Projection::parallel ? 1 : -glm::dot(to, axes.back);
                    ASSERT_GT(depth, 0);
                    const double pixel =
                        glm::length(projection == Projection::parallel ? rays.origin_x : rays.dir_x);
                    most = std::max({most,
                                     std::abs(glm::dot(to, axes.right)) / depth / pixel / picture.width * 2,
                                     std::abs(glm::dot(to, axes.up)) / depth / pixel / picture.height * 2});
                }
                EXPECT_LE(most, 1);
                EXPECT_GE(most, 0.9);
            }
        }
    }
}

TEST(Viewpoint, ThePivotComesToTheMiddleAndKeepsItsSize) {
    for (const Projection projection : both) {
        Viewpoint viewpoint{.orbit = {20, 10, 0, {}, 15}, .projection = projection};
        const view::Vec3 point{8, -3, 5}, beside = point + view::picture_axes(viewpoint.orbit).right;
        const auto apart = [&] {
            return glm::distance(project(camera(viewpoint, flat_lattice), point),
                                 project(camera(viewpoint, flat_lattice), beside));
        };
        const double before = apart();
        set_pivot(viewpoint, point, flat_lattice);
        EXPECT_EQ(viewpoint.orbit.target, point);
        EXPECT_NEAR(apart(), before, 1e-6);
        const auto seen = project(camera(viewpoint, flat_lattice), point);
        EXPECT_NEAR(seen.x, size.width / 2.0, 1e-6);
        EXPECT_NEAR(seen.y, size.height / 2.0, 1e-6);
    }
}

TEST(Flight, BeginsWhereTheEyeIs) {
    for (const double distance : {0.0, 5.0, 1000.0}) {
        Viewpoint viewpoint{.orbit = {20, 10, distance, {3, 2, 1}, 30}};
        const auto before = camera(viewpoint, flat_lattice);
        begin_flight(viewpoint, flat_lattice);
        const auto after = camera(viewpoint, flat_lattice);
        EXPECT_NEAR(glm::distance(after.eye, before.eye), 0, 1e-6 * glm::length(before.eye));
        EXPECT_NEAR(
            glm::dot(glm::normalize(after.target - after.eye), glm::normalize(before.target - before.eye)), 1,
            1e-9);
    }
    Viewpoint parallel{.orbit = {}, .projection = Projection::parallel};
    begin_flight(parallel, flat_lattice);
    EXPECT_EQ(parallel.projection, Projection::perspective);
}

// The way does not depend on how the time is cut into passes.
TEST(Flight, GoesWhereItLooks) {
    Viewpoint viewpoint{.orbit = {20, 10, 0, {}, 30}};
    begin_flight(viewpoint, flat_lattice);
    const auto before = camera(viewpoint, flat_lattice);
    const double distance = distance_of(viewpoint, flat_lattice);
    Viewpoint in_steps = viewpoint;
    fly(viewpoint, {0, 0, 1}, 1, 1, flat_lattice);
    for (int i = 0; i < 50; ++i) {
        fly(in_steps, {0, 0, 1}, 1, 0.02, flat_lattice);
    }
    const auto after = camera(viewpoint, flat_lattice);
    EXPECT_NEAR(glm::distance(after.eye, camera(in_steps, flat_lattice).eye), 0, 1e-9);
    const view::Vec3 way = after.eye - before.eye;
    EXPECT_NEAR(glm::length(way), distance / 2, 1e-9);
    EXPECT_NEAR(glm::dot(glm::normalize(way), glm::normalize(before.target - before.eye)), 1, 1e-9);
    fly(viewpoint, {1, 0, 0}, 2, 0.5, flat_lattice);
    fly(viewpoint, {0, 1, 0}, 2, 0.5, flat_lattice);
    const view::PictureAxes axes = view::picture_axes(viewpoint.orbit);
    const view::Vec3 aside = camera(viewpoint, flat_lattice).eye - after.eye;
    EXPECT_NEAR(glm::dot(aside, axes.right), distance / 2, 1e-9);
    EXPECT_NEAR(glm::dot(aside, axes.up), distance / 2, 1e-9);
    for (int i = 0; i < 1000; ++i) {
        fly(viewpoint, {1, 1, 1}, 1e9, 0.1, flat_lattice);
    }
    EXPECT_TRUE(view::validate(camera(viewpoint, flat_lattice), size)) << "nobody is lost";
}

TEST(Flight, LooksAroundFromWhereItIs) {
    Viewpoint viewpoint{.orbit = {20, 10, 0, {}, 30}};
    begin_flight(viewpoint, flat_lattice);
    const auto before = camera(viewpoint, flat_lattice);
    look_around(viewpoint, 12, -7, size, flat_lattice);
    const auto after = camera(viewpoint, flat_lattice);
    EXPECT_NEAR(glm::distance(after.eye, before.eye), 0, 1e-9);
    const auto seen = project(after, before.target);
    EXPECT_NEAR(seen.x, size.width / 2.0 + 12, 1.5);
    EXPECT_NEAR(seen.y, size.height / 2.0 - 7, 1.5);
}

TEST(Numbers, AreReadAndTyped) {
    for (const Projection projection : both) {
        for (const Units units : {Units::world, Units::voxels}) {
            Viewpoint viewpoint{.orbit = {}, .projection = projection};
            for (int which = 0; which <= static_cast<int>(Number::target_z); ++which) {
                const double typed = 11.5 + which;
                ASSERT_TRUE(set_number(viewpoint, static_cast<Number>(which), typed, units, flat_lattice));
                EXPECT_NEAR(number(viewpoint, static_cast<Number>(which), units, flat_lattice), typed, 1e-9)
                    << which;
            }
            EXPECT_TRUE(view::validate(camera(viewpoint, flat_lattice), size));
        }
    }
    Viewpoint viewpoint;
    ASSERT_TRUE(set_number(viewpoint, Number::target_y, 0, Units::voxels, flat_lattice));
    EXPECT_NEAR(viewpoint.orbit.target.y, -15.5, 1e-12);
    ASSERT_TRUE(set_number(viewpoint, Number::azimuth, 370, Units::world, flat_lattice));
    EXPECT_NEAR(viewpoint.orbit.azimuth, 10, 1e-9);
    Viewpoint parallel{.orbit = {}, .projection = Projection::parallel};
    ASSERT_TRUE(set_number(parallel, Number::height, 40, Units::world, flat_lattice));
    EXPECT_NEAR(camera(parallel, flat_lattice).height, 40, 1e-9);
}

TEST(Numbers, OutOfRangeChangeNothing) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Viewpoint viewpoint;
    const Viewpoint before = viewpoint;
    for (int which = 0; which <= static_cast<int>(Number::target_z); ++which) {
        for (const double bad : {nan, infinity, -infinity, 1e9}) {
            for (const Units units : {Units::world, Units::voxels}) {
                const auto set = set_number(viewpoint, static_cast<Number>(which), bad, units, flat_lattice);
                ASSERT_FALSE(set) << which << " " << bad;
                EXPECT_NE(set.error().detail.find("a number from"), std::string::npos);
            }
        }
    }
    EXPECT_FALSE(set_number(viewpoint, Number::distance, 0, Units::world, flat_lattice));
    EXPECT_FALSE(set_number(viewpoint, Number::elevation, 90.5, Units::world, flat_lattice));
    EXPECT_EQ(viewpoint, before);
}

}  // namespace
}  // namespace shearwater::model
