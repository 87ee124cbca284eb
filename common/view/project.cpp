#include "common/view/project.h"

namespace shearwater::view {

Projected project(const Camera& camera, const ImageSize& size, const Vec3& world) {
    const Axes axes = axes_of(camera);
    const Vec3 from_eye = world - camera.eye;
    const double depth = glm::dot(from_eye, axes.forward);
    Vec2 across{glm::dot(from_eye, axes.right), glm::dot(from_eye, axes.up)};
    // On the projection plane: one unit away in perspective, through the eye in a parallel view.
    across = camera.projection == Projection::perspective ? across / depth - camera.slant
                                                          : across - depth * camera.slant;
    const double pixels_per_unit = size.height / height_at(camera, 1);
    return {{0.5 * size.width + across.x * pixels_per_unit, 0.5 * size.height - across.y * pixels_per_unit},
            depth};
}

}  // namespace shearwater::view
