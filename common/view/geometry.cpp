#include "common/view/geometry.h"

namespace shearwater::view {

namespace {

Vec3 last_voxel(const Lattice& lattice) {
    return Vec3(static_cast<double>(lattice.n[0] - 1), static_cast<double>(lattice.n[1] - 1),
                static_cast<double>(lattice.n[2] - 1));
}

}  // namespace

Vec3 Lattice::voxel_from_world(const Vec3& world) const {
    return world / spacing + 0.5 * last_voxel(*this);
}

Vec3 Lattice::world_from_voxel(const Vec3& voxel) const {
    return spacing * (voxel - 0.5 * last_voxel(*this));
}

double Lattice::diagonal() const {
    return glm::length(spacing * last_voxel(*this));
}

}  // namespace shearwater::view
