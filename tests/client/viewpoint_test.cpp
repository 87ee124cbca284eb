#include "client/model/viewpoint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace shearwater::model {
namespace {

using view::ImageSize;
using view::Projection;

const view::Lattice lattice{.n = {64, 32, 16}, .spacing = {1, 1, 2}};
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
        const auto mine = camera(viewpoint, lattice);
        const auto designs = view::camera_on(view::Orbit{}, lattice, projection, 30, 0);
        EXPECT_NEAR(glm::distance(mine.eye, designs.eye), 0, 1e-9);
        EXPECT_NEAR(mine.height, lattice.diagonal(), 1e-9);
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
    EXPECT_TRUE(view::validate(camera(viewpoint, lattice), size));
    drag_orbit(viewpoint, 0, -10000, size);
    EXPECT_GT(viewpoint.orbit.elevation, -90);
}

// Dragging to the right moves what is in front to the right, downwards moves it down.
TEST(Viewpoint, WhatIsInFrontFollowsTheDrag) {
    Viewpoint viewpoint;
    const auto before = camera(viewpoint, lattice);
    const view::Vec3 front = before.target + 0.2 * (before.eye - before.target);
    drag_orbit(viewpoint, 30, 20, size);
    const auto moved = project(camera(viewpoint, lattice), front);
    EXPECT_GT(moved.x, size.width / 2.0 + 1);
    EXPECT_GT(moved.y, size.height / 2.0 + 1);
}

TEST(Viewpoint, PanMovesTheTargetWithTheMouse) {
    for (const Projection projection : both) {
        Viewpoint viewpoint;
        viewpoint.projection = projection;
        const view::Vec3 before = camera(viewpoint, lattice).target;
        pan(viewpoint, 37, -21, size, lattice);
        const auto seen = project(camera(viewpoint, lattice), before);
        EXPECT_NEAR(seen.x, size.width / 2.0 + 37, 1e-6);
        EXPECT_NEAR(seen.y, size.height / 2.0 - 21, 1e-6);
    }
}

TEST(Viewpoint, ZoomKeepsThePointUnderTheCursor) {
    for (const Projection projection : both) {
        Viewpoint viewpoint;
        viewpoint.projection = projection;
        const view::Vec2 cursor{500, 100};
        const view::Vec3 point = point_at(camera(viewpoint, lattice), cursor);
        const double before = camera(viewpoint, lattice).height;
        zoom(viewpoint, 0.6, cursor.x, cursor.y, size, lattice);
        const auto after = camera(viewpoint, lattice);
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
            zoom(viewpoint, 0.8, 640, 0, size, lattice);
            pan(viewpoint, 1000, 1000, size, lattice);
        }
        EXPECT_TRUE(view::validate(camera(viewpoint, lattice), size));
        for (int i = 0; i < 300; ++i) {
            zoom(viewpoint, 1.25, 640, 0, size, lattice);
            pan(viewpoint, -1000, 500, size, lattice);
        }
        EXPECT_TRUE(view::validate(camera(viewpoint, lattice), size));
        set_fov(viewpoint, std::numeric_limits<double>::quiet_NaN(), lattice);
        EXPECT_TRUE(view::validate(camera(viewpoint, lattice), size));
    }
}

TEST(Viewpoint, TheFieldOfViewKeepsTheScale) {
    Viewpoint viewpoint;
    zoom(viewpoint, 0.7, 320, 240, size, lattice);
    const double height = camera(viewpoint, lattice).height;
    set_fov(viewpoint, 90, lattice);
    EXPECT_EQ(viewpoint.fov, 90);
    EXPECT_NEAR(camera(viewpoint, lattice).height, height, 1e-9);
    set_fov(viewpoint, 1000, lattice);
    EXPECT_EQ(viewpoint.fov, max_fov);
}

}  // namespace
}  // namespace shearwater::model
