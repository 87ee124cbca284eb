#include "client/model/viewpoint.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shearwater::model {

namespace {

constexpr double radians = std::numbers::pi / 180;
constexpr double max_elevation = 89;
constexpr double nearest = 1e-3, farthest = 20;  // distances, in diagonals
constexpr double farthest_target = 2;            // from the origin, in diagonals

bool is_parallel(const Viewpoint& viewpoint) {
    return viewpoint.projection == view::Projection::parallel;
}

// World height of the picture at the target's depth.
double height_at_target(const Viewpoint& viewpoint, const view::Lattice& lattice) {
    const double half = viewpoint.fov / 2 * radians;
    return 2 * distance_of(viewpoint, lattice) * (is_parallel(viewpoint) ? std::sin(half) : std::tan(half));
}

// World offset of (dx, dy) pixels at the target's depth.
view::Vec3 offset_at_target(const Viewpoint& viewpoint, double dx, double dy, const view::ImageSize& size,
                            const view::Lattice& lattice) {
    const view::PictureAxes axes = view::picture_axes(viewpoint.orbit);
    return (dx * axes.right - dy * axes.up) * (height_at_target(viewpoint, lattice) / size.height);
}

void move_target(Viewpoint& viewpoint, const view::Vec3& by, const view::Lattice& lattice) {
    const double limit = farthest_target * lattice.diagonal();
    viewpoint.orbit.target = glm::clamp(viewpoint.orbit.target + by, -limit, limit);
}

double within_reach(double distance, const view::Lattice& lattice) {
    return std::clamp(distance, nearest * lattice.diagonal(), farthest * lattice.diagonal());
}

double in_a_circle(double degrees) {
    return std::remainder(degrees, 360);
}

// A pole, once looked from, is not left by itself.
void turn(view::Orbit& orbit, double azimuth, double elevation) {
    const double limit = std::max(max_elevation, std::abs(orbit.elevation));
    orbit.azimuth = in_a_circle(orbit.azimuth + azimuth);
    orbit.elevation = std::clamp(orbit.elevation + elevation, -limit, limit);
}

struct Offset {
    double x, y;  // of a picture, y downwards
};

// As it would be in a picture without roll.
Offset upright(const view::Orbit& orbit, double dx, double dy) {
    const double c = std::cos(orbit.roll * radians), s = std::sin(orbit.roll * radians);
    return {c * dx - s * dy, s * dx + c * dy};
}

}  // namespace

void drag_orbit(Viewpoint& viewpoint, double dx, double dy, const view::ImageSize& size) {
    const double degrees_per_pixel = 180.0 / size.height;
    const Offset drag = upright(viewpoint.orbit, dx, dy);
    turn(viewpoint.orbit, -drag.x * degrees_per_pixel, drag.y * degrees_per_pixel);
}

void roll(Viewpoint& viewpoint, double degrees) {
    viewpoint.orbit.roll = in_a_circle(viewpoint.orbit.roll + degrees);
}

void drag_roll(Viewpoint& viewpoint, double x, double y, double dx, double dy, const view::ImageSize& size) {
    const double from_x = x - dx - size.width / 2.0, from_y = y - dy - size.height / 2.0;
    const double to_x = x - size.width / 2.0, to_y = y - size.height / 2.0;
    constexpr double too_close = 4;  // pixels: a direction is not to be had
    if (std::hypot(from_x, from_y) < too_close || std::hypot(to_x, to_y) < too_close) {
        return;
    }
    // Clockwise, as y goes downwards.
    const double angle = std::atan2(to_y, to_x) - std::atan2(from_y, from_x);
    roll(viewpoint, -in_a_circle(angle / radians));
}

void pan(Viewpoint& viewpoint, double dx, double dy, const view::ImageSize& size,
         const view::Lattice& lattice) {
    move_target(viewpoint, -offset_at_target(viewpoint, dx, dy, size, lattice), lattice);
}

void zoom(Viewpoint& viewpoint, double factor, double x, double y, const view::ImageSize& size,
          const view::Lattice& lattice) {
    const double before = distance_of(viewpoint, lattice);
    const double after = within_reach(before * factor, lattice);
    const view::Vec3 cursor =
        offset_at_target(viewpoint, x - size.width / 2.0, y - size.height / 2.0, size, lattice);
    move_target(viewpoint, cursor * (1 - after / before), lattice);
    viewpoint.orbit.distance = after;
}

void toggle_projection(Viewpoint& viewpoint) {
    viewpoint.projection =
        is_parallel(viewpoint) ? view::Projection::perspective : view::Projection::parallel;
}

void set_fov(Viewpoint& viewpoint, double fov, const view::Lattice& lattice) {
    const double before = distance_of(viewpoint, lattice);
    const double to = std::isfinite(fov) ? std::clamp(fov, min_fov, max_fov) : viewpoint.fov;
    if (viewpoint.orbit.distance > 0) {
        viewpoint.orbit.distance =
            before * std::sin(viewpoint.fov / 2 * radians) / std::sin(to / 2 * radians);
    }
    viewpoint.fov = to;
}

void look_from(Viewpoint& viewpoint, Side side) {
    struct Angles {
        double azimuth, elevation;
    };
    constexpr std::array<Angles, 6> angles{{{90, 0}, {-90, 0}, {0, 90}, {0, -90}, {0, 0}, {180, 0}}};
    const Angles& to = angles[static_cast<std::size_t>(side)];
    viewpoint.orbit.azimuth = to.azimuth;
    viewpoint.orbit.elevation = to.elevation;
    viewpoint.orbit.roll = 0;
}

// Each corner of the cube asks for a distance at which it is in the picture.
void fit(Viewpoint& viewpoint, const view::ImageSize& size, const view::Lattice& lattice) {
    constexpr double margin = 1.04;
    const view::PictureAxes axes = view::picture_axes(viewpoint.orbit);
    const double aspect = static_cast<double>(size.width) / size.height;
    const double half = viewpoint.fov / 2 * radians;
    const double reach = (is_parallel(viewpoint) ? std::sin(half) : std::tan(half)) / margin;
    double distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        view::Vec3 voxel{0};
        for (int axis = 0; axis < 3; ++axis) {
            voxel[axis] = (corner >> axis & 1) != 0
                              ? static_cast<double>(lattice.n[static_cast<std::size_t>(axis)] - 1)
                              : 0.0;
        }
        const view::Vec3 at = lattice.world_from_voxel(voxel);
        const double sideways =
            std::max(std::abs(glm::dot(at, axes.up)), std::abs(glm::dot(at, axes.right)) / aspect);
        const double towards = is_parallel(viewpoint) ? 0 : glm::dot(at, axes.back);
        distance = std::max(distance, towards + sideways / reach);
    }
    viewpoint.orbit.target = {0, 0, 0};
    viewpoint.orbit.distance = within_reach(distance, lattice);
}

void set_pivot(Viewpoint& viewpoint, const view::Vec3& point, const view::Lattice& lattice) {
    const double distance = distance_of(viewpoint, lattice);
    const view::Vec3 away = viewpoint.orbit.target - point;
    const double nearer = glm::dot(away, view::picture_axes(viewpoint.orbit).back);
    move_target(viewpoint, -away, lattice);
    viewpoint.orbit.distance = is_parallel(viewpoint) ? distance : within_reach(distance + nearer, lattice);
}

void reset(Viewpoint& viewpoint) {
    viewpoint = {.orbit = {}, .projection = viewpoint.projection};
}

void begin_flight(Viewpoint& viewpoint, const view::Lattice& lattice) {
    const double before = distance_of(viewpoint, lattice);
    const view::Vec3 back = view::picture_axes(viewpoint.orbit).back;
    const view::Vec3 eye = viewpoint.orbit.target + before * back;
    // Near, but no farther from the cube than targets are let.
    const double near =
        std::max(lattice.diagonal() / 4, glm::length(eye) - farthest_target * lattice.diagonal());
    const double distance = std::min(before, near);
    viewpoint.projection = view::Projection::perspective;
    move_target(viewpoint, eye - distance * back - viewpoint.orbit.target, lattice);
    viewpoint.orbit.distance = distance;
}

void fly(Viewpoint& viewpoint, const Thrust& thrust, double pace, double seconds,
         const view::Lattice& lattice) {
    const view::PictureAxes axes = view::picture_axes(viewpoint.orbit);
    const view::Vec3 direction = thrust.x * axes.right + thrust.y * axes.up - thrust.z * axes.back;
    const double way =
        0.5 * distance_of(viewpoint, lattice) * std::clamp(pace, min_pace, max_pace) * std::max(seconds, 0.0);
    move_target(viewpoint, way * direction, lattice);
}

void look_around(Viewpoint& viewpoint, double dx, double dy, const view::ImageSize& size,
                 const view::Lattice& lattice) {
    view::Orbit& orbit = viewpoint.orbit;
    const double distance = distance_of(viewpoint, lattice);
    const view::Vec3 eye = orbit.target + distance * view::picture_axes(orbit).back;
    const double degrees_per_pixel = viewpoint.fov / size.height;
    const Offset drag = upright(orbit, dx, dy);
    turn(orbit, drag.x * degrees_per_pixel, -drag.y * degrees_per_pixel);
    move_target(viewpoint, eye - distance * view::picture_axes(orbit).back - orbit.target, lattice);
    orbit.distance = distance;
}

}  // namespace shearwater::model
