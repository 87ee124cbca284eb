#include "common/view/camera.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

namespace shearwater::view {

namespace {

constexpr double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

base::Status refuse_camera(std::string detail) {
    return base::error(base::Code::invalid_argument, "set the view", std::move(detail));
}

}  // namespace

PictureAxes picture_axes(const Orbit& orbit) {
    const double az = radians(orbit.azimuth), el = radians(orbit.elevation), roll = radians(orbit.roll);
    const Vec3 right{std::cos(az), 0, -std::sin(az)};
    const Vec3 up{-std::sin(az) * std::sin(el), std::cos(el), -std::cos(az) * std::sin(el)};
    return {.right = std::cos(roll) * right - std::sin(roll) * up,
            .up = std::cos(roll) * up + std::sin(roll) * right,
            .back = glm::cross(right, up)};
}

Camera camera_on(const Orbit& orbit, const Lattice& lattice, Projection projection, double fov,
                 double height) {
    const double az = radians(orbit.azimuth);
    const double el = radians(orbit.elevation);
    const double distance =
        orbit.distance > 0 ? orbit.distance : 0.5 * lattice.diagonal() / std::sin(0.5 * radians(fov));
    Camera camera;
    camera.target = orbit.target;
    camera.eye = orbit.target +
                 distance * Vec3(std::sin(az) * std::cos(el), std::sin(el), std::cos(az) * std::cos(el));
    // Over a pole +y is the line of sight; the limit of the pictures on the way there is still a picture.
    const bool over_pole = std::abs(std::cos(el)) < 1e-6;
    camera.up = over_pole || orbit.roll != 0 ? picture_axes(orbit).up : Vec3(0, 1, 0);
    camera.projection = projection;
    camera.fov = fov;
    camera.height = height > 0 ? height : lattice.diagonal();
    return camera;
}

Axes axes_of(const Camera& camera) {
    const Vec3 forward = glm::normalize(camera.target - camera.eye);
    const Vec3 right = glm::normalize(glm::cross(forward, camera.up));
    return {right, glm::cross(right, forward), forward};
}

double height_at(const Camera& camera, double depth) {
    return camera.projection == Projection::perspective ? 2 * depth * std::tan(0.5 * radians(camera.fov))
                                                        : camera.height;
}

Rays rays_of(const Camera& camera, const ImageSize& size) {
    const Axes axes = axes_of(camera);
    const bool perspective = camera.projection == Projection::perspective;
    const double pixel = height_at(camera, 1) / size.height;
    const Vec3 step_x = pixel * axes.right;
    const Vec3 step_y = -pixel * axes.up;
    const Vec3 corner = -0.5 * size.width * step_x - 0.5 * size.height * step_y;

    Rays rays{.projection = camera.projection,
              .origin = camera.eye,
              .origin_x = Vec3(0),
              .origin_y = Vec3(0),
              .dir = axes.forward + camera.slant.x * axes.right + camera.slant.y * axes.up,
              .dir_x = Vec3(0),
              .dir_y = Vec3(0)};
    if (perspective) {
        rays.dir += corner;
        rays.dir_x = step_x;
        rays.dir_y = step_y;
    } else {
        rays.origin += corner;
        rays.origin_x = step_x;
        rays.origin_y = step_y;
    }
    return rays;
}

Rays in_voxel_space(const Rays& world, const Lattice& lattice) {
    return {.projection = world.projection,
            .origin = lattice.voxel_from_world(world.origin),
            .origin_x = lattice.voxel_direction(world.origin_x),
            .origin_y = lattice.voxel_direction(world.origin_y),
            .dir = lattice.voxel_direction(world.dir),
            .dir_x = lattice.voxel_direction(world.dir_x),
            .dir_y = lattice.voxel_direction(world.dir_y)};
}

base::Status validate(const Camera& camera, const ImageSize& size) {
    constexpr int max_side = 8192;
    constexpr std::int64_t max_pixels = std::int64_t{1} << 25;
    if (size.width < 1 || size.height < 1 || size.width > max_side || size.height > max_side ||
        std::int64_t{size.width} * size.height > max_pixels) {
        return refuse_camera("a picture is 1 to 8192 pixels a side and at most 2^25 in all");
    }
    if (camera.projection == Projection::perspective) {
        if (!(camera.fov > 0 && camera.fov < 180)) {
            return refuse_camera("the field of view has to be above 0 and below 180 degrees");
        }
    } else if (!(camera.height > 0) || !std::isfinite(camera.height)) {
        return refuse_camera("the height of a parallel view has to be above 0");
    }
    if (!finite(camera.eye) || !finite(camera.target) || !finite(camera.up)) {
        return refuse_camera("the eye, the target and the up direction have to be finite");
    }
    if (!(glm::length(camera.slant) <= Camera::max_slant)) {
        return refuse_camera("the picture's middle is too far off the camera's axis");
    }
    const Vec3 sight = camera.target - camera.eye;
    const double distance = glm::length(sight);
    const double up = glm::length(camera.up);
    if (!(distance > 1e-100) || !std::isfinite(distance)) {
        return refuse_camera("the eye is on its target, or too far from it");
    }
    if (!(up > 1e-100) || !std::isfinite(up) ||
        !(glm::length(glm::cross(sight / distance, camera.up / up)) > 1e-9)) {
        return refuse_camera("the up direction is along the line of sight");
    }
    return {};
}

}  // namespace shearwater::view
