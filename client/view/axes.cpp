#include "client/view/axes.h"

#include <algorithm>
#include <cmath>

namespace shearwater::ui {

namespace {

constexpr float radius = 30, inset = 14;  // nominal pixels

struct Line {
    std::string label;
    ImU32 colour = 0;
    ImVec2 end{};      // from the centre, y downwards
    double depth = 0;  // towards the eye
};

Line line_of(const Desk& desk, int along) {
    const auto [right, up, back] = view::picture_axes(desk.wish.viewpoint.orbit);
    view::Vec3 direction(0);
    direction[along] = 1;
    const auto a = static_cast<std::size_t>(along);
    Line line{.label = std::string(1, "xyz"[along]), .colour = axis_colours[a]};
    if (desk.has_cube()) {
        const wcs::Axis axis = wcs::shown_axis(*desk.status.cube->world, along, desk.lattice().n);
        line.label = axis.label;
        direction *= wcs::rises(axis, along, desk.lattice().n) ? 1 : -1;
    }
    const float length = desk.px(radius - 8);
    line.end = {static_cast<float>(glm::dot(direction, right)) * length,
                static_cast<float>(-glm::dot(direction, up)) * length};
    line.depth = glm::dot(direction, back);
    return line;
}

}  // namespace

EyeArea axes_area(const Desk& desk, ImVec2 from, ImVec2 size) {
    const float side = 2 * desk.px(radius + inset);
    return {{from.x, from.y + size.y - side}, {side, side}};
}

void draw_axes(const Desk& desk, const EyeArea& area) {
    const ImVec2 centre{area.from.x + area.size.x / 2, area.from.y + area.size.y / 2};
    std::array lines{line_of(desk, 0), line_of(desk, 1), line_of(desk, 2)};
    std::ranges::sort(lines, {}, &Line::depth);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImFont* const font = desk.fonts.small;
    ImVec2 sum;
    for (const Line& line : lines) {
        sum = {sum.x + line.end.x, sum.y + line.end.y};
    }
    const float size = std::hypot(sum.x, sum.y);
    for (const Line& line : lines) {
        const ImVec2 end{centre.x + line.end.x, centre.y + line.end.y};
        list.AddLine(centre, end, line.colour, desk.px(1.5F));
        const ImVec2 label = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, line.label.c_str());
        // Beyond the end, whatever the label's shape. Where it is seen end on, away from the others.
        const float reach = std::hypot(line.end.x, line.end.y);
        const ImVec2 away{-sum.x / std::max(size, 1.0F), -sum.y / std::max(size, 1.0F)};
        const ImVec2 along = reach > desk.px(2) ? ImVec2{line.end.x / reach, line.end.y / reach} : away;
        const float beyond = desk.px(3) + (std::abs(along.x) * label.x + std::abs(along.y) * label.y) / 2;
        const float x = end.x + along.x * beyond - label.x / 2;
        list.AddText(font, font->FontSize,
                     {std::max(x, area.from.x + desk.px(4)), end.y + along.y * beyond - label.y / 2},
                     line.colour, line.label.c_str());
    }
}

}  // namespace shearwater::ui
