#pragma once
// Where a picture shows a point of the world: the inverse of rays_of.

#include "common/view/camera.h"

namespace shearwater::view {

struct Projected {
    Vec2 at{};         // pixels from the picture's upper left corner, y downwards
    double depth = 0;  // along the camera's forward, from the eye

    // Whether a ray of the camera comes to it: in perspective only what is before the eye is seen.
    bool seen_by(const Camera& camera) const {
        return camera.projection == Projection::parallel || depth > 0;
    }
};

// The camera and size are valid. What is not seen has any place.
Projected project(const Camera& camera, const ImageSize& size, const Vec3& world);

}  // namespace shearwater::view
