#pragma once
// How a person moves the faces of the box that the cube is cropped to.

#include <optional>

#include "common/view/camera.h"
#include "common/volume/box.h"

namespace shearwater::model {

using Crop = std::optional<volume::Box>;  // nothing: the whole cube

struct BoxFace {
    int axis = 0;
    bool upper = false;
    bool operator==(const BoxFace&) const = default;
};

// What is shown of the cube. A crop of another cube is none.
volume::Box shown_box(const Crop& crop, const view::Lattice& lattice);

// Moves a face to a plane of voxels, or as near as it may come: inside the cube, and a voxel from the other.
void move_face(Crop& crop, const view::Lattice& lattice, BoxFace face, std::int64_t plane);

// The middle of a face in the world.
view::Vec3 middle_of(const volume::Box& box, const view::Lattice& lattice, BoxFace face);

// How many planes a face moves with a drag of its middle by (dx, dy) pixels, y downwards: it follows the
// mouse along its axis as the picture shows that. Nothing where that is seen end on.
double planes_dragged(const volume::Box& box, const view::Lattice& lattice, BoxFace face,
                      const view::Camera& camera, const view::ImageSize& size, view::Vec2 by);

}  // namespace shearwater::model
