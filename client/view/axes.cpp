#include "client/view/axes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace shearwater::ui {

namespace {

struct Axis {
    const char* label;
    view::Vec3 direction;
    ImU32 colour;
    ImVec2 end{};      // from the centre, y downwards
    double depth = 0;  // towards the eye
};

}  // namespace

void draw_axes(const Desk& desk, ImVec2 centre) {
    const auto [right, up, back] = view::picture_axes(desk.wish.viewpoint.orbit);
    std::array axes{Axis{"x", {1, 0, 0}, IM_COL32(232, 110, 104, 255)},
                    Axis{"y", {0, 1, 0}, IM_COL32(120, 200, 130, 255)},
                    Axis{"z", {0, 0, 1}, IM_COL32(106, 160, 250, 255)}};
    for (Axis& axis : axes) {
        const float length = desk.px(axes_radius - 8);
        axis.end = {static_cast<float>(glm::dot(axis.direction, right)) * length,
                    static_cast<float>(-glm::dot(axis.direction, up)) * length};
        axis.depth = glm::dot(axis.direction, back);
    }
    std::ranges::sort(axes, {}, &Axis::depth);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImFont* font = desk.fonts.small;
    for (const Axis& axis : axes) {
        const ImVec2 end{centre.x + axis.end.x, centre.y + axis.end.y};
        list.AddLine(centre, end, axis.colour, desk.px(1.5F));
        const ImVec2 label = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, axis.label);
        const float reach = std::hypot(axis.end.x, axis.end.y);
        const float beyond = reach > 0 ? 1 + desk.px(8) / std::max(reach, desk.px(8)) : 0;
        list.AddText(
            font, font->FontSize,
            {centre.x + axis.end.x * beyond - label.x / 2, centre.y + axis.end.y * beyond - label.y / 2},
            axis.colour, axis.label);
    }
}

}  // namespace shearwater::ui
