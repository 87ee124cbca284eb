#pragma once
// Where a person looks from.

#include <array>
#include <string_view>

#include "common/view/camera.h"

namespace shearwater::view {

// By number.
inline constexpr std::array<std::string_view, 2> projection_names{"perspective", "parallel"};

// An orbit about a target. One number, the distance, sets the scale of both projections, so that switching
// between them keeps the picture's size: the parallel height is 2 distance sin(fov / 2).
struct Viewpoint {
    Orbit orbit;  // distance 0: the whole cube is seen
    Projection projection = Projection::perspective;
    double fov = 30;  // vertical, degrees

    bool operator==(const Viewpoint&) const = default;
};

inline constexpr double min_fov = 5;
inline constexpr double max_fov = 120;

// From the target, world units; the orbit's, or where that is 0 what it stands for.
double distance_of(const Viewpoint& viewpoint, const Lattice& lattice);
Camera camera(const Viewpoint& viewpoint, const Lattice& lattice);

// Refuses what is not finite, a negative distance, an elevation beyond a pole, and a field of view outside
// [min_fov, max_fov].
base::Status validate(const Viewpoint& viewpoint);

}  // namespace shearwater::view
