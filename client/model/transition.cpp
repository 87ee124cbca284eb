#include "client/model/transition.h"

#include <algorithm>
#include <cmath>

namespace shearwater::model {

void Transition::begin(const Viewpoint& from, const Viewpoint& to, wire::Time now,
                       const view::Lattice& lattice) {
    jump_ = Jump{from, to, distance_of(from, lattice), distance_of(to, lattice), now};
}

std::optional<Viewpoint> Transition::at(wire::Time now) {
    if (!jump_) {
        return std::nullopt;
    }
    const auto& [from, to, from_distance, to_distance, began] = *jump_;
    const std::chrono::duration<double> passed = now - began;
    const double t = std::clamp(passed / std::chrono::duration<double>(length), 0.0, 1.0);
    if (t >= 1) {
        const Viewpoint end = to;
        jump_.reset();
        return end;
    }
    const double share = t * t * (3 - 2 * t);
    const auto between = [share](double a, double b) { return a + share * (b - a); };
    const auto angle = [share](double a, double b) {
        return std::remainder(a + share * std::remainder(b - a, 360), 360);
    };
    Viewpoint view = to;
    view.orbit.azimuth = angle(from.orbit.azimuth, to.orbit.azimuth);
    view.orbit.elevation = between(from.orbit.elevation, to.orbit.elevation);
    view.orbit.roll = angle(from.orbit.roll, to.orbit.roll);
    view.orbit.distance = from_distance * std::pow(to_distance / from_distance, share);
    view.orbit.target = from.orbit.target + share * (to.orbit.target - from.orbit.target);
    view.fov = between(from.fov, to.fov);
    return view;
}

}  // namespace shearwater::model
