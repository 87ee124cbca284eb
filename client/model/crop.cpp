#include "client/model/crop.h"

#include <algorithm>

#include "common/view/factorisation.h"
#include "common/view/project.h"

namespace shearwater::model {

volume::Box shown_box(const Crop& crop, const view::Lattice& lattice) {
    return crop && view::validate_crop(*crop, lattice.n) ? *crop : volume::whole(lattice.n);
}

void move_face(Crop& crop, const view::Lattice& lattice, BoxFace face, std::int64_t plane) {
    volume::Box box = shown_box(crop, lattice);
    const auto a = static_cast<std::size_t>(face.axis);
    if (face.upper) {
        box.hi[a] = std::clamp(plane, box.lo[a] + 1, lattice.n[a] - 1);
    } else {
        box.lo[a] = std::clamp(plane, std::int64_t{0}, box.hi[a] - 1);
    }
    crop = box == volume::whole(lattice.n) ? Crop() : box;
}

view::Vec3 middle_of(const volume::Box& box, const view::Lattice& lattice, BoxFace face) {
    view::Vec3 voxel;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        voxel[axis] = axis == face.axis ? static_cast<double>(face.upper ? box.hi[a] : box.lo[a])
                                        : static_cast<double>(box.lo[a] + box.hi[a]) / 2;
    }
    return lattice.world_from_voxel(voxel);
}

double planes_dragged(const volume::Box& box, const view::Lattice& lattice, BoxFace face,
                      const view::Camera& camera, const view::ImageSize& size, view::Vec2 by) {
    const view::Vec3 middle = middle_of(box, lattice, face);
    view::Vec3 voxel_farther(0);
    voxel_farther[face.axis] = lattice.spacing[face.axis];
    const view::Projected here = view::project(camera, size, middle);
    const view::Projected there = view::project(camera, size, middle + voxel_farther);
    const view::Vec2 per_plane = there.at - here.at;
    const double length = glm::length(per_plane);
    constexpr double end_on = 1e-3;  // pixels a plane
    if (!here.seen_by(camera) || !there.seen_by(camera) || !(length > end_on)) {
        return 0;
    }
    return glm::dot(by, per_plane) / (length * length);
}

}  // namespace shearwater::model
