#pragma once
// Vectors, and the two spaces of a cube (design: section 3).
//   voxel space   fractional voxel indices (common/volume/box.h)
//   world space   spacing * (voxel - (n - 1) / 2), the cube's middle at the origin

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/volume/box.h"

namespace shearwater::view {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;

inline bool finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// The grid a cube's samples lie on.
struct Lattice {
    volume::Index3 n{};     // voxels along each axis, each at least 2
    Vec3 spacing{1, 1, 1};  // world units between voxels, each above 0

    Vec3 voxel_from_world(const Vec3& world) const;
    Vec3 world_from_voxel(const Vec3& voxel) const;
    // The same for directions, which no origin moves.
    Vec3 voxel_direction(const Vec3& world) const { return world / spacing; }
    double diagonal() const;  // |spacing * (n - 1)|
    bool operator==(const Lattice&) const = default;
};

}  // namespace shearwater::view
