#include "client/view/eye_areas.h"

#include <algorithm>
#include <cmath>

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

EyeArea fitted(ImVec2 from, ImVec2 size, const view::ImageSize& picture) {
    const auto width = static_cast<float>(picture.width), height = static_cast<float>(picture.height);
    const float fit = std::min(size.x / width, size.y / height);
    // Its sides are whole pixels, which may be large ones.
    const float rounding = std::max(2.0F, fit);
    const bool fills =
        std::abs(size.x - width * fit) < rounding && std::abs(size.y - height * fit) < rounding;
    const ImVec2 shown = fills ? size : ImVec2{std::round(width * fit), std::round(height * fit)};
    return {{from.x + std::floor((size.x - shown.x) / 2), from.y + std::floor((size.y - shown.y) / 2)},
            shown,
            {}};
}

std::vector<EyeArea> eye_areas(const Shown& shown, ImVec2 from, ImVec2 size) {
    if (shown == StereoMode::side_by_side) {
        const ImVec2 half{size.x / 2, size.y};
        return {{from, half, {}}, {{from.x + half.x, from.y}, half, {}}};
    }
    if (shown == StereoMode::top_bottom) {
        const ImVec2 half{size.x, size.y / 2};
        return {{from, half, {}}, {{from.x, from.y + half.y}, half, {}}};
    }
    if (shown == StereoMode::quad_buffered) {
        return {{from, size, Eye::left}, {from, size, Eye::right}};
    }
    return {{from, size, {}}};
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
        case StereoMode::quad_buffered:
            return {left, right};
        case StereoMode::left:
        case StereoMode::two_windows:
            return {left};
        case StereoMode::right:
            return {right};
        default:
            return {};
    }
}

}  // namespace shearwater::ui
