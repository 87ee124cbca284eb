// The viewpoint as numbers that can be read and typed.

#include <fmt/format.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "client/model/viewpoint.h"

namespace shearwater::model {

namespace {

double sine_of_half(const Viewpoint& viewpoint) {
    return std::sin(glm::radians(viewpoint.fov) / 2);
}

int axis_of(Number which) {
    return static_cast<int>(which) - static_cast<int>(Number::target_x);
}

// Of a number in the units it is typed in.
struct Range {
    double lo, hi;
};
Range range_of(const Viewpoint& viewpoint, Number which, Units units, const view::Lattice& lattice) {
    const double diagonal = lattice.diagonal();
    const Range distances{1e-3 * diagonal, 20 * diagonal};
    switch (which) {
        case Number::azimuth:
        case Number::roll:
            return {-1e6, 1e6};
        case Number::elevation:
            return {-90, 90};
        case Number::distance:
            return distances;
        case Number::height:
            return {2 * sine_of_half(viewpoint) * distances.lo, 2 * sine_of_half(viewpoint) * distances.hi};
        case Number::fov:
            return {min_fov, max_fov};
        case Number::target_x:
        case Number::target_y:
        case Number::target_z:
            break;
    }
    const view::Vec3 lo(-2 * diagonal), hi(2 * diagonal);
    const int axis = axis_of(which);
    return units == Units::world
               ? Range{lo[axis], hi[axis]}
               : Range{lattice.voxel_from_world(lo)[axis], lattice.voxel_from_world(hi)[axis]};
}

}  // namespace

double number(const Viewpoint& viewpoint, Number which, Units units, const view::Lattice& lattice) {
    const view::Orbit& orbit = viewpoint.orbit;
    switch (which) {
        case Number::azimuth:
            return orbit.azimuth;
        case Number::elevation:
            return orbit.elevation;
        case Number::roll:
            return orbit.roll;
        case Number::distance:
            return distance_of(viewpoint, lattice);
        case Number::height:
            return 2 * distance_of(viewpoint, lattice) * sine_of_half(viewpoint);
        case Number::fov:
            return viewpoint.fov;
        case Number::target_x:
        case Number::target_y:
        case Number::target_z:
            break;
    }
    return (units == Units::world ? orbit.target : lattice.voxel_from_world(orbit.target))[axis_of(which)];
}

base::Status set_number(Viewpoint& viewpoint, Number which, double value, Units units,
                        const view::Lattice& lattice) {
    const Range range = range_of(viewpoint, which, units, lattice);
    if (!(value >= range.lo && value <= range.hi)) {
        return base::error(base::Code::invalid_argument, "set the camera",
                           fmt::format("a number from {:.6g} to {:.6g} is wanted", range.lo, range.hi));
    }
    view::Orbit& orbit = viewpoint.orbit;
    switch (which) {
        case Number::azimuth:
            orbit.azimuth = std::remainder(value, 360);
            break;
        case Number::elevation:
            orbit.elevation = value;
            break;
        case Number::roll:
            orbit.roll = std::remainder(value, 360);
            break;
        case Number::distance:
            orbit.distance = value;
            break;
        case Number::height:
            orbit.distance = value / (2 * sine_of_half(viewpoint));
            break;
        case Number::fov:
            set_fov(viewpoint, value, lattice);
            break;
        case Number::target_x:
        case Number::target_y:
        case Number::target_z: {
            view::Vec3 target = units == Units::world ? orbit.target : lattice.voxel_from_world(orbit.target);
            target[axis_of(which)] = value;
            orbit.target = units == Units::world ? target : lattice.world_from_voxel(target);
            break;
        }
    }
    return {};
}

}  // namespace shearwater::model
