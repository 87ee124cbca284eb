#include <algorithm>
#include <cmath>
#include <limits>

#include "client/view/function_plot.h"
#include "client/view/function_tab.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

constexpr float reach = 13;  // of a handle, nominal pixels

// The handle of the selected pin within reach, the nearest of them.
std::optional<std::size_t> handle_under(const Desk& desk, const Plot& plot, ImVec2 mouse) {
    if (!desk.editor.pin) {
        return std::nullopt;
    }
    const auto places = handle_places(desk, plot, desk.wish.tf.opacity_pins[*desk.editor.pin]);
    std::optional<std::size_t> nearest;
    float least = desk.px(reach);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const float away = std::hypot(places[i].x - mouse.x, places[i].y - mouse.y);
        if (away < least) {
            least = away;
            nearest = i;
        }
    }
    return nearest;
}

// Of the pins whose area the mouse is in, or on whose outline, that which is narrowest: the others can be had
// beside it.
std::optional<std::size_t> pin_under(const Desk& desk, const Plot& plot, ImVec2 mouse) {
    const auto& pins = desk.wish.tf.opacity_pins;
    const double s = plot.s_at(mouse.x);
    std::optional<std::size_t> found;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < pins.size(); ++i) {
        const auto* blank = std::get_if<view::Blank>(&pins[i]);
        const double height = model::height_at(pins[i], s);
        const bool inside = blank != nullptr ? blank->lo <= s && s <= blank->hi
                                             : height > 0 && mouse.y >= plot.y(height) - desk.px(5);
        const std::vector<double> edges = model::edges_of(pins[i]);
        const double width = edges.empty() ? 1.5 : edges.back() - edges.front();
        if (inside && width < least) {
            found = i;
            least = width;
        }
    }
    return found;
}

void take_hold(Desk& desk, const Plot& plot, ImVec2 mouse) {
    EditorState& editor = desk.editor;
    auto handle = handle_under(desk, plot, mouse);
    if (!handle) {
        editor.pin = pin_under(desk, plot, mouse);
        editor.colour.reset();
        handle = handle_under(desk, plot, mouse);
    }
    if (!editor.pin) {
        return;
    }
    Held held{.pin = *editor.pin, .handle = handle, .s = plot.s_at(mouse.x)};
    if (handle) {
        const auto at = model::handles_of(desk.wish.tf.opacity_pins[held.pin])[*handle];
        held.ds = std::clamp(at.s, 0.0, 1.0) - held.s;
        held.up = at.height ? model::height_share(plot.axis, *at.height) - plot.share_at(mouse.y) : 0;
    }
    editor.held = held;
}

std::vector<double> targets(const Desk& desk, const Plot& plot, std::size_t but) {
    const int wanted = std::max(4, static_cast<int>(plot.width() / desk.px(30)));
    return model::snap_targets(desk.wish.tf, but, model::ticks(scale_of(desk), shown_unit(desk), wanted));
}

void drag(Desk& desk, const Plot& plot, ImVec2 mouse) {
    Held& held = *desk.editor.held;
    view::OpacityPin& pin = desk.wish.tf.opacity_pins[held.pin];
    const bool snaps = ImGui::GetIO().KeyCtrl;
    const double near = static_cast<double>(desk.px(10) / plot.width());
    const double at = plot.s_at(mouse.x);
    view::OpacityPin moved = pin;
    if (held.handle) {
        double s = std::clamp(at + held.ds, 0.0, 1.0);
        s = snaps ? model::snapped(s, targets(desk, plot, held.pin), near) : s;
        moved = model::dragged(pin, *held.handle, s,
                               model::opacity_at(plot.axis, plot.share_at(mouse.y) + held.up));
    } else {
        moved = model::shifted(pin, at - held.s);
        const std::vector<double> edges = model::edges_of(moved);
        if (snaps && !edges.empty()) {  // by its lower edge, from where it would be
            const double to = model::snapped(edges.front(), targets(desk, plot, held.pin), near);
            moved = model::shifted(moved, to - edges.front());
            held.s = at + to - edges.front();
        } else {
            held.s = at;
        }
    }
    desk.dragging = true;
    pin = moved;
}

void context_menu(Desk& desk) {
    if (!ImGui::BeginPopup("at a place")) {
        return;
    }
    if (desk.escape) {
        ImGui::CloseCurrentPopup();
    }
    for (const model::Shape shape : model::shapes) {
        const std::string label(model::name(shape));
        if (ImGui::Selectable(("add a " + label).c_str())) {
            add_pin(desk, shape, desk.editor.menu_s, desk.editor.menu_opacity);
        }
        desk.controls.note("editor/menu/" + label);
    }
    if (desk.editor.pin) {
        ImGui::Separator();
        if (ImGui::Selectable("delete this pin")) {
            delete_selected(desk);
        }
        desk.controls.note("editor/menu/delete");
    }
    ImGui::EndPopup();
}

}  // namespace

bool plot_mouse(Desk& desk, const Plot& plot) {
    EditorState& editor = desk.editor;
    const float margin = desk.px(6);
    ImGui::SetCursorScreenPos({plot.from.x - margin, plot.from.y - margin});
    ImGui::InvisibleButton("plot", {plot.width() + 2 * margin, plot.height() + margin + desk.px(5)},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    desk.controls.note("editor/plot");
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const bool by_right =
        ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseReleased(ImGuiMouseButton_Right);
    if (ImGui::IsItemActivated() && !by_right) {
        take_hold(desk, plot, mouse);
    } else if (!ImGui::IsItemActive()) {
        editor.held.reset();
    } else if (editor.held && (ImGui::GetIO().MouseDelta.x != 0 || ImGui::GetIO().MouseDelta.y != 0)) {
        drag(desk, plot, mouse);
    }
    if (ImGui::IsItemHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Right)) {
        editor.menu_s = std::clamp(plot.s_at(mouse.x), 0.0, 1.0);
        editor.menu_opacity = model::opacity_at(plot.axis, plot.share_at(mouse.y));
        if (const auto pin = pin_under(desk, plot, mouse)) {
            editor.pin = pin;
        }
        ImGui::OpenPopup("at a place");
    }
    const bool hovered = ImGui::IsItemHovered();
    if (editor.held || (hovered && handle_under(desk, plot, mouse))) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    }
    context_menu(desk);
    return hovered;
}

}  // namespace shearwater::ui
