#include "client/view/eye_areas.h"

namespace shearwater::ui {

using image::StereoMode;

ImVec2 EyeArea::from_pixels(view::Vec2 at, const view::ImageSize& picture) const {
    return {from.x + static_cast<float>(at.x / picture.width) * size.x,
            from.y + static_cast<float>(at.y / picture.height) * size.y};
}

view::Vec2 EyeArea::to_pixels(ImVec2 at, const view::ImageSize& picture) const {
    return {static_cast<double>((at.x - from.x) / size.x) * picture.width,
            static_cast<double>((at.y - from.y) / size.y) * picture.height};
}

std::vector<EyeArea> eye_areas(const Shown& shown, ImVec2 from, ImVec2 size) {
    if (shown == StereoMode::side_by_side) {
        const ImVec2 half{size.x / 2, size.y};
        return {{from, half}, {{from.x + half.x, from.y}, half}};
    }
    if (shown == StereoMode::top_bottom) {
        const ImVec2 half{size.x, size.y / 2};
        return {{from, half}, {{from.x, from.y + half.y}, half}};
    }
    return {{from, size}};
}

std::vector<view::Camera> cameras_of_areas(const Shown& shown, const view::Camera& camera,
                                           const view::StereoSettings& eyes) {
    if (!shown) {
        return {camera};
    }
    const auto [left, right] = view::eyes_of(camera, eyes);
    switch (*shown) {
        case StereoMode::side_by_side:
        case StereoMode::top_bottom:
            return {left, right};
        case StereoMode::left:
            return {left};
        case StereoMode::right:
            return {right};
        default:
            return {};
    }
}

}  // namespace shearwater::ui
