#pragma once
// Where in the picture's rectangle each eye's picture lies, and points of the world in it.

#include <imgui.h>

#include <optional>
#include <vector>

#include "client/view/eye_gates.h"
#include "common/image/stereo_modes.h"
#include "common/view/project.h"
#include "common/view/stereo.h"

namespace shearwater::ui {

// How a pair is shown; nothing: there is one picture.
using Shown = std::optional<image::StereoMode>;

struct EyeArea {
    ImVec2 from, size;        // window coordinates
    std::optional<Eye> only;  // who sees what is drawn there; else both, if they look there

    bool contains(ImVec2 at) const {
        return at.x >= from.x && at.y >= from.y && at.x < from.x + size.x && at.y < from.y + size.y;
    }
    // Of a picture of that size, its pixels.
    ImVec2 from_pixels(view::Vec2 at, const view::ImageSize& picture) const;
    view::Vec2 to_pixels(ImVec2 at, const view::ImageSize& picture) const;
};

// The largest in the middle of a rectangle that a picture of such a size fills in proportion.
EyeArea fitted(ImVec2 from, ImVec2 size, const view::ImageSize& picture);

// One, or two beside or below one another or in one place, the left eye's first. All are of one size.
std::vector<EyeArea> eye_areas(const Shown& shown, ImVec2 from, ImVec2 size);

// The cameras of those areas whose pictures are one eye's alone; none where both are mixed in one.
std::vector<view::Camera> cameras_of_areas(const Shown& shown, const view::Camera& camera,
                                           const view::StereoSettings& eyes);

}  // namespace shearwater::ui
