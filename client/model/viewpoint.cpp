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

double distance_of(const Viewpoint& viewpoint, const view::Lattice& lattice) {
    return viewpoint.orbit.distance > 0 ? viewpoint.orbit.distance
                                        : lattice.diagonal() / 2 / std::sin(viewpoint.fov / 2 * radians);
}

// World height of the picture at the target's depth.
double height_at_target(const Viewpoint& viewpoint, const view::Lattice& lattice) {
    const double half = viewpoint.fov / 2 * radians;
    const bool parallel = viewpoint.projection == view::Projection::parallel;
    return 2 * distance_of(viewpoint, lattice) * (parallel ? std::sin(half) : std::tan(half));
}

// World offset of (dx, dy) pixels at the target's depth.
view::Vec3 offset_at_target(const Viewpoint& viewpoint, double dx, double dy, const view::ImageSize& size,
                            const view::Lattice& lattice) {
    const double az = viewpoint.orbit.azimuth * radians, el = viewpoint.orbit.elevation * radians;
    const view::Vec3 right{std::cos(az), 0, -std::sin(az)};
    const view::Vec3 up{-std::sin(az) * std::sin(el), std::cos(el), -std::cos(az) * std::sin(el)};
    return (dx * right - dy * up) * (height_at_target(viewpoint, lattice) / size.height);
}

void move_target(Viewpoint& viewpoint, const view::Vec3& by, const view::Lattice& lattice) {
    const double limit = farthest_target * lattice.diagonal();
    viewpoint.orbit.target = glm::clamp(viewpoint.orbit.target + by, -limit, limit);
}

}  // namespace

bool Viewpoint::operator==(const Viewpoint& other) const {
    return orbit.azimuth == other.orbit.azimuth && orbit.elevation == other.orbit.elevation &&
           orbit.distance == other.orbit.distance && orbit.target == other.orbit.target &&
           projection == other.projection && fov == other.fov;
}

view::Camera camera(const Viewpoint& viewpoint, const view::Lattice& lattice) {
    const double height = 2 * distance_of(viewpoint, lattice) * std::sin(viewpoint.fov / 2 * radians);
    return view::camera_on(viewpoint.orbit, lattice, viewpoint.projection, viewpoint.fov, height);
}

void drag_orbit(Viewpoint& viewpoint, double dx, double dy, const view::ImageSize& size) {
    const double degrees_per_pixel = 180.0 / size.height;
    view::Orbit& orbit = viewpoint.orbit;
    orbit.azimuth = std::remainder(orbit.azimuth - dx * degrees_per_pixel, 360);
    orbit.elevation = std::clamp(orbit.elevation + dy * degrees_per_pixel, -max_elevation, max_elevation);
}

void pan(Viewpoint& viewpoint, double dx, double dy, const view::ImageSize& size,
         const view::Lattice& lattice) {
    move_target(viewpoint, -offset_at_target(viewpoint, dx, dy, size, lattice), lattice);
}

void zoom(Viewpoint& viewpoint, double factor, double x, double y, const view::ImageSize& size,
          const view::Lattice& lattice) {
    const double before = distance_of(viewpoint, lattice);
    const double after =
        std::clamp(before * factor, nearest * lattice.diagonal(), farthest * lattice.diagonal());
    const view::Vec3 cursor =
        offset_at_target(viewpoint, x - size.width / 2.0, y - size.height / 2.0, size, lattice);
    move_target(viewpoint, cursor * (1 - after / before), lattice);
    viewpoint.orbit.distance = after;
}

void toggle_projection(Viewpoint& viewpoint) {
    viewpoint.projection = viewpoint.projection == view::Projection::parallel ? view::Projection::perspective
                                                                              : view::Projection::parallel;
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

}  // namespace shearwater::model
