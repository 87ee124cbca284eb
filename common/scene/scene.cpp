#include "common/scene/scene.h"

#include <cmath>

namespace shearwater::scene {

// Which cube a crop is of is not known here.
constexpr volume::Index3 longest_axes{1 << 30, 1 << 30, 1 << 30};

base::Status validate(const Scene& scene) {
    if (const auto valid = view::validate(scene.viewpoint); !valid) {
        return valid;
    }
    if (const auto valid = view::validate(view::Camera{}, scene.size); !valid) {
        return valid;
    }
    if (const auto valid = view::validate(scene.tf); !valid) {
        return valid;
    }
    if (const auto valid = culling::validate(scene.culling); !valid) {
        return valid;
    }
    if (!(scene.target_rate >= Scene::min_rate && scene.target_rate <= Scene::max_rate)) {
        return base::error(base::Code::invalid_argument, "set the frame rate", "1 to 60 a second are held");
    }
    if (scene.stereo && !(scene.stereo->eyes.separation >= 0 && scene.stereo->eyes.convergence >= 0 &&
                          std::isfinite(scene.stereo->eyes.separation + scene.stereo->eyes.convergence))) {
        return base::error(base::Code::invalid_argument, "set the eyes", "their distances are not below 0");
    }
    if (scene.crop && !view::validate_crop(*scene.crop, longest_axes)) {
        return base::error(base::Code::invalid_argument, "set the crop box",
                           "it ends behind where it begins, from voxel 0 on");
    }
    if (scene.scaling && !scene.scaling->valid()) {
        return base::error(base::Code::invalid_argument, "set the limits",
                           "they are finite, the lower first");
    }
    return {};
}

}  // namespace shearwater::scene
