#include "common/scene/scene.h"

namespace shearwater::scene {

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
    return {};
}

}  // namespace shearwater::scene
