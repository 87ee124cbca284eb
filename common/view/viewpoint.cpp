#include "common/view/viewpoint.h"

#include <cmath>
#include <numbers>

namespace shearwater::view {

namespace {

double sine_of_half(double fov) {
    return std::sin(fov / 2 * std::numbers::pi / 180);
}

}  // namespace

double distance_of(const Viewpoint& viewpoint, const Lattice& lattice) {
    return viewpoint.orbit.distance > 0 ? viewpoint.orbit.distance
                                        : lattice.diagonal() / 2 / sine_of_half(viewpoint.fov);
}

Camera camera(const Viewpoint& viewpoint, const Lattice& lattice) {
    const double height = 2 * distance_of(viewpoint, lattice) * sine_of_half(viewpoint.fov);
    return camera_on(viewpoint.orbit, lattice, viewpoint.projection, viewpoint.fov, height);
}

base::Status validate(const Viewpoint& viewpoint) {
    const auto refuse = [](const char* detail) {
        return base::error(base::Code::invalid_argument, "set the viewpoint", detail);
    };
    const Orbit& orbit = viewpoint.orbit;
    constexpr double farthest = 1e12;  // world units: far beyond any cube
    const auto within = [](double value, double limit) { return std::abs(value) <= limit; };
    if (!within(orbit.azimuth, 1e6) || !within(orbit.roll, 1e6)) {
        return refuse("azimuth and roll are angles in degrees");
    }
    if (!within(orbit.elevation, 90)) {
        return refuse("the elevation is -90 to 90 degrees");
    }
    if (!(orbit.distance >= 0) || !within(orbit.distance, farthest)) {
        return refuse("the distance is above 0, or 0 for the whole cube");
    }
    if (!within(orbit.target.x, farthest) || !within(orbit.target.y, farthest) ||
        !within(orbit.target.z, farthest)) {
        return refuse("the target is three numbers, in world units");
    }
    if (!(viewpoint.fov >= min_fov && viewpoint.fov <= max_fov)) {
        return refuse("the field of view is 5 to 120 degrees");
    }
    return {};
}

}  // namespace shearwater::view
