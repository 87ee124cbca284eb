#include "client/view/colour_bar.h"

#include <algorithm>
#include <cmath>

#include "client/model/colours.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

struct Bar {
    ImVec2 from, to;
    float x(double s) const { return from.x + (to.x - from.x) * static_cast<float>(std::clamp(s, 0.0, 1.0)); }
    double s_at(float px) const { return static_cast<double>((px - from.x) / (to.x - from.x)); }
};

std::optional<std::size_t> pin_under(const Desk& desk, const Bar& bar, float x) {
    const auto& pins = desk.wish.tf.colour_pins;
    std::optional<std::size_t> nearest;
    float least = desk.px(7);
    for (std::size_t i = 0; i < pins.size(); ++i) {
        if (const float away = std::abs(bar.x(pins[i].at) - x); away < least) {
            least = away;
            nearest = i;
        }
    }
    return nearest;
}

void mouse(Desk& desk, const Bar& bar) {
    EditorState& editor = desk.editor;
    view::TransferFunction& tf = desk.wish.tf;
    const float x = ImGui::GetIO().MousePos.x;
    const double at = std::clamp(bar.s_at(x), 0.0, 1.0);
    const auto under = pin_under(desk, bar, x);
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && !under) {
        editor.colour = model::add_colour(tf, at);
        editor.pin.reset();
        editor.held_colour.reset();
        return;
    }
    if (ImGui::IsItemActivated()) {
        editor.colour = under;
        editor.pin.reset();
        editor.held_colour = under ? std::optional(tf.colour_pins[*under].at - at) : std::nullopt;
    } else if (!ImGui::IsItemActive()) {
        editor.held_colour.reset();
    } else if (editor.held_colour && editor.colour && ImGui::GetIO().MouseDelta.x != 0) {
        model::move_colour(tf, *editor.colour, std::clamp(at + *editor.held_colour, 0.0, 1.0));
        desk.dragging = true;
    }
    if (ImGui::IsItemHovered() && (under || editor.held_colour)) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    }
}

}  // namespace

void colour_bar(Desk& desk, ImVec2 from, ImVec2 to) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const Bar bar{from, to};
    const float mark = desk.px(4);
    draw_gradient(list, desk.wish.tf.colour_pins, from, to, 0);
    ImGui::SetCursorScreenPos({from.x - mark, from.y});
    ImGui::InvisibleButton("colours", {to.x - from.x + 2 * mark, to.y - from.y + 2 * mark});
    desk.controls.note("editor/colours");
    mouse(desk, bar);
    const auto& pins = desk.wish.tf.colour_pins;
    // A map has many pins, of which each is small until one is taken.
    const bool is_map = !view::colour_map_name(pins).empty();
    const bool has_room = (to.x - from.x) / static_cast<float>(pins.size()) > desk.px(14);
    for (std::size_t i = 0; i < pins.size(); ++i) {
        const bool selected = desk.editor.colour == i;
        const float r = selected ? mark * 1.3F : is_map ? mark * 0.6F : mark;
        const float x = bar.x(pins[i].at);
        if (selected || !is_map || has_room) {
            list.AddTriangleFilled({x - r, to.y + 2 * r}, {x + r, to.y + 2 * r}, {x, to.y - desk.px(1)},
                                   selected ? IM_COL32(255, 196, 92, 255)
                                   : is_map ? theme::vacant
                                            : theme::text);
        }
        if (pins.size() <= 40) {
            desk.controls.note("editor/colour/" + std::to_string(i), {x, to.y - desk.px(3)});
        }
    }
}

}  // namespace shearwater::ui
