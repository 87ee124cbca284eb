#include "client/view/function_tab.h"

#include <fmt/core.h>

#include "client/model/colours.h"
#include "client/view/colour_bar.h"
#include "client/view/function_fields.h"
#include "client/view/function_plot.h"
#include "client/view/preset_menu.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

constexpr float fields_width = 284, gap = 12;  // nominal pixels

// A button with the shape's outline on it.
bool shape_button(Desk& desk, model::Shape shape) {
    const std::string label(model::name(shape));
    const float height = ImGui::GetFrameHeight();
    const ImVec2 size{height * 1.25F, height};
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::Button(("##add " + label).c_str(), size);
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("add a %s", label.c_str());
    }
    desk.controls.note("editor/add/" + label);
    const auto at = [&](double x, double y) {
        return ImVec2{from.x + size.x * static_cast<float>(0.18 + 0.64 * x),
                      from.y + size.y * static_cast<float>(0.78 - 0.56 * y)};
    };
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (shape == model::Shape::blank) {
        list.AddRect(at(0.2, 0), at(0.8, 1), theme::text, 0, 0, desk.px(1.2F));
        list.AddLine(at(0.2, 0), at(0.8, 1), theme::text, desk.px(1.2F));
        return pressed;
    }
    const view::OpacityPin pin = model::retyped(view::Hat{0.5, 0.5, 1, 0.95}, shape);
    std::vector<ImVec2> outline;
    for (const double s : {0.0, 1e-6, 0.25, 0.5, 0.75, 1 - 1e-6, 1.0}) {
        const bool foot = shape == model::Shape::top_hat && (s == 0 || s == 1);
        outline.push_back(at(s, foot ? 0 : shape == model::Shape::flat ? 0.5 : model::height_at(pin, s)));
    }
    list.AddPolyline(outline.data(), static_cast<int>(outline.size()), theme::text, 0, desk.px(1.4F));
    return pressed;
}

void unit_choice(Desk& desk) {
    const auto words = [&](view::Unit unit) -> std::string {
        switch (unit) {
            case view::Unit::stretched:
                return "0 to 1, stretched";
            case view::Unit::value: {
                const std::string data = desk.has_cube() ? desk.status.cube->unit : "";
                return data.empty() ? "data values" : data;
            }
            case view::Unit::percentile:
                return "percentiles";
            case view::Unit::sigma:
                return "median + N \u03c3";
        }
        return {};
    };
    ImGui::SetNextItemWidth(desk.px(132));
    if (begin_choice(desk, "##unit", words(shown_unit(desk)), "editor/unit", "the unit of positions")) {
        for (const view::Unit unit :
             {view::Unit::value, view::Unit::percentile, view::Unit::sigma, view::Unit::stretched}) {
            const std::string fault = desk.has_cube() ? desk.status.cube->scale().fault_of(unit) : "";
            const auto flags = fault.empty() ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
            if (ImGui::Selectable(words(unit).c_str(), unit == desk.editor.unit, flags)) {
                desk.editor.unit = unit;
            }
            desk.controls.note("editor/unit/" + std::string(view::name(unit)));
        }
        ImGui::EndCombo();
    }
}

void axis_choice(Desk& desk) {
    ImGui::SetNextItemWidth(desk.px(94));
    if (begin_choice(desk, "##axis", std::string(model::name(desk.editor.axis)), "editor/axis",
                     "the opacity axis")) {
        for (const auto axis :
             {model::OpacityAxis::cube_root, model::OpacityAxis::logarithmic, model::OpacityAxis::linear}) {
            const std::string label(model::name(axis));
            if (ImGui::Selectable(label.c_str(), axis == desk.editor.axis)) {
                desk.editor.axis = axis;
            }
            desk.controls.note("editor/axis/" + label);
        }
        ImGui::EndCombo();
    }
}

}  // namespace

void function_tools(Desk& desk) {
    for (const model::Shape shape : model::shapes) {
        if (shape_button(desk, shape)) {
            add_pin(desk, shape, 0.5, 0.1);
        }
        ImGui::SameLine(0, desk.px(3));
    }
    const float presets = ImGui::CalcTextSize("Presets").x + 2 * ImGui::GetStyle().FramePadding.x;
    const float right = ImGui::GetWindowContentRegionMax().x;
    ImGui::SameLine(right - presets - desk.px(132 + 94 + 12));
    unit_choice(desk);
    ImGui::SameLine();
    axis_choice(desk);
    ImGui::SameLine();
    preset_menu(desk);
}

void function_body(Desk& desk) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float column = std::min(desk.px(fields_width), room.x / 2);
    const ImVec2 to{from.x + room.x - column - desk.px(gap), from.y + room.y};
    const float bar = desk.px(13), marks = desk.fonts.small->FontSize + desk.px(3);
    const Plot plot{{from.x + desk.px(6), from.y + desk.px(6)},
                    {to.x - desk.px(6), to.y - marks - bar - desk.px(15)},
                    desk.editor.axis};
    function_plot(desk, plot);
    colour_bar(desk, {plot.from.x, plot.to.y + desk.px(5)}, {plot.to.x, plot.to.y + desk.px(5) + bar});
    value_marks(desk, plot, to.y - marks);
    ImGui::SetCursorScreenPos({to.x + desk.px(gap), from.y});
    ImGui::BeginChild("fields", {column, room.y}, false, ImGuiWindowFlags_NoScrollbar);
    function_fields(desk);
    ImGui::EndChild();
}

void delete_selected(Desk& desk) {
    EditorState& editor = desk.editor;
    view::TransferFunction& tf = desk.wish.tf;
    if (editor.pin && *editor.pin < tf.opacity_pins.size()) {
        tf.opacity_pins.erase(tf.opacity_pins.begin() + static_cast<std::ptrdiff_t>(*editor.pin));
        editor.pin.reset();
        editor.held.reset();
    } else if (editor.colour) {
        model::remove_colour(tf, *editor.colour);
        editor.colour.reset();
        editor.held_colour.reset();
    }
}

void begin_editor_pass(Desk& desk) {
    EditorState& editor = desk.editor;
    const view::TransferFunction& tf = desk.wish.tf;
    if (editor.pin && *editor.pin >= tf.opacity_pins.size()) {
        editor.pin.reset();
        editor.held.reset();
    }
    if (editor.colour && *editor.colour >= tf.colour_pins.size()) {
        editor.colour.reset();
        editor.held_colour.reset();
    }
    take_presets(desk);
}

}  // namespace shearwater::ui
