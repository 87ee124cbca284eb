#include "common/view/stereo.h"

#include <cmath>
#include <cstdint>
#include <utility>

namespace shearwater::view {

StereoSettings resolved(const StereoSettings& settings, const Camera& camera) {
    StereoSettings all = settings;
    if (!(all.convergence > 0)) {
        all.convergence = glm::length(camera.target - camera.eye);
    }
    if (!(all.separation > 0)) {
        all.separation = StereoSettings::default_share * all.convergence;
    }
    return all;
}

std::array<Camera, 2> eyes_of(const Camera& camera, const StereoSettings& settings) {
    const StereoSettings all = resolved(settings, camera);
    const Vec3 right = axes_of(camera).right;
    const auto shifted = [&](double by) {
        Camera eye = camera;
        eye.eye += by * right;
        eye.target += by * right;
        eye.slant.x -= by / all.convergence;
        return eye;
    };
    std::array<Camera, 2> eyes{shifted(-all.separation / 2), shifted(all.separation / 2)};
    if (all.swap) {
        std::swap(eyes[0], eyes[1]);
    }
    return eyes;
}

double parallax(const Camera& camera, const StereoSettings& settings, double depth, const ImageSize& size) {
    const StereoSettings all = resolved(settings, camera);
    const double farther = camera.projection == Projection::perspective ? 1 - all.convergence / depth
                                                                        : depth / all.convergence - 1;
    const double pixels_per_world = size.height / height_at(camera, all.convergence);
    return (all.swap ? -1 : 1) * all.separation * farther * pixels_per_world;
}

base::Status validate(const StereoSettings& settings, const Camera& camera, const ImageSize& size) {
    const auto refuse = [](const char* why) {
        return base::error(base::Code::invalid_argument, "set the pair of eyes", why);
    };
    if (!(settings.separation >= 0) || !(settings.convergence >= 0) || !std::isfinite(settings.separation) ||
        !std::isfinite(settings.convergence)) {
        return refuse("the eyes' separation and convergence have to be finite and not below 0");
    }
    for (const Camera& eye : eyes_of(camera, settings)) {
        if (!validate(eye, size)) {
            return refuse("the eyes are too far apart for where they converge");
        }
    }
    constexpr std::int64_t max_pixels = std::int64_t{1} << 25;
    if (2 * std::int64_t{size.width} * size.height > max_pixels) {
        return refuse("a pair of pictures has at most 2^25 pixels in all");
    }
    return {};
}

}  // namespace shearwater::view
