#include "client/view/edge_scales.h"

#include <algorithm>
#include <cmath>

#include "client/model/crop.h"
#include "client/model/edge_scales.h"
#include "client/view/axes.h"

namespace shearwater::ui {

namespace {

ImVec2 in_window(const EyeArea& area, view::Vec2 at) {
    return {area.from.x + static_cast<float>(at.x), area.from.y + static_cast<float>(at.y)};
}

// On a plate of its own: the picture's background may be of any colour.
void draw_label(const Desk& desk, ImDrawList& list, ImVec2 from, view::Vec2 size, const std::string& words,
                ImU32 colour) {
    constexpr ImU32 plate = IM_COL32(11, 12, 15, 170);
    const ImVec2 to{from.x + static_cast<float>(size.x), from.y + static_cast<float>(size.y)};
    list.AddRectFilled(from, to, plate, desk.px(3));
    list.AddText(desk.fonts.small, desk.fonts.small->FontSize,
                 {std::round(from.x + desk.px(2)), std::round(from.y)}, colour, words.c_str());
}

}  // namespace

void draw_edge_scales(Desk& desk, const EyeArea& area, const view::Camera& camera, const EyeArea& taken,
                      bool noted) {
    const ImFont& font = *desk.fonts.small;
    const double margin = static_cast<double>(desk.px(2));
    const model::ScaleStyle style{
        .mark = static_cast<double>(desk.px(5)),
        .gap = static_cast<double>(desk.px(4)),
        .size_of =
            [&](const std::string& words) {
                const ImVec2 size = font.CalcTextSizeA(font.FontSize, FLT_MAX, 0, words.c_str());
                return view::Vec2{static_cast<double>(size.x) + 2 * margin, static_cast<double>(size.y)};
            },
        .reserved = {{{static_cast<double>(taken.from.x - area.from.x),
                       static_cast<double>(taken.from.y - area.from.y)},
                      {static_cast<double>(taken.size.x), static_cast<double>(taken.size.y)}}}};
    const view::ImageSize size{std::max(1, static_cast<int>(std::lround(area.size.x))),
                               std::max(1, static_cast<int>(std::lround(area.size.y)))};
    const wcs::Axes& world = *desk.status.cube->world;
    const volume::Box box = model::shown_box(desk.wish.crop, desk.lattice());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(area.from, {area.from.x + area.size.x, area.from.y + area.size.y}, true);
    for (const model::EdgeScale& scale :
         model::edge_scales(camera, size, desk.lattice(), box, world, style)) {
        const auto along = static_cast<std::size_t>(scale.along);
        for (const auto& [from, to] : scale.marks) {
            list.AddLine(in_window(area, from), in_window(area, to), axis_colours[along], desk.px(1.5F));
        }
        for (std::size_t i = 0; i < scale.labels.size(); ++i) {
            const auto& [plate, words] = scale.labels[i];
            const bool title = scale.titled && i + 1 == scale.labels.size();
            draw_label(desk, list, in_window(area, plate.from), plate.size, words,
                       title ? axis_colours[along] : theme::text);
            if (noted) {
                const std::string name = wcs::shown_axis(world, scale.along, desk.lattice().n).label;
                desk.controls.note("scale/" + name + "/" + words,
                                   in_window(area, plate.from + plate.size / 2.0));
            }
        }
    }
    list.PopClipRect();
}

}  // namespace shearwater::ui
