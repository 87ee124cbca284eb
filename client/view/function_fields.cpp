#include "client/view/function_fields.h"

#include <algorithm>
#include <cmath>

#include "client/model/colours.h"
#include "client/view/function_plot.h"
#include "client/view/function_tab.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

// One of two columns: a label, and a number behind it that is typed.
bool labelled_number(Desk& desk, const std::string& label, double& value, bool left) {
    const float label_width = desk.px(50);
    const float width = (ImGui::GetWindowContentRegionMax().x - desk.px(8)) / 2;
    if (!left) {
        ImGui::SameLine(width + desk.px(8));
    }
    ImGui::AlignTextToFramePadding();
    small_text(desk, theme::muted, label);
    ImGui::SameLine((left ? 0 : width + desk.px(8)) + label_width);
    ImGui::SetNextItemWidth(width - label_width);
    const bool set = number_field(desk, "##" + label, value);
    std::string name = label;
    std::replace(name.begin(), name.end(), ' ', '-');
    desk.controls.note("editor/field/" + name);
    return set;
}

void shape_choice(Desk& desk, view::OpacityPin& pin) {
    const model::Shape current = model::shape_of(pin);
    const float button = ImGui::CalcTextSize("Delete").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - desk.px(6));
    if (begin_choice(desk, "##shape", std::string(model::name(current)), "editor/shape")) {
        for (const model::Shape shape : model::shapes) {
            const std::string label(model::name(shape));
            if (ImGui::Selectable(label.c_str(), shape == current)) {
                pin = model::retyped(pin, shape);
            }
            desk.controls.note("editor/shape/" + label);
        }
        ImGui::EndCombo();
    }
}

bool delete_button(Desk& desk) {
    ImGui::SameLine(0, desk.px(6));
    const bool pressed = ImGui::Button("Delete");
    desk.controls.note("editor/delete");
    return pressed;
}

void pin_fields(Desk& desk) {
    view::OpacityPin& pin = desk.wish.tf.opacity_pins[*desk.editor.pin];
    ImGui::PushID(static_cast<int>(*desk.editor.pin));
    shape_choice(desk, pin);
    const bool deletes = delete_button(desk);
    const view::ValueScale scale = scale_of(desk);
    const view::Unit unit = shown_unit(desk);
    const auto fields = model::fields_of(pin);
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const double kept = model::field(pin, i);
        double value = fields[i].is_height ? kept : scale.from_s(unit, kept);
        if (labelled_number(desk, std::string(fields[i].name), value, i % 2 == 0)) {
            pin = model::with_field(pin, i, fields[i].is_height ? value : scale.to_s(unit, value));
        }
    }
    ImGui::PopID();
    if (deletes) {
        delete_selected(desk);
    }
}

void colour_fields(Desk& desk) {
    view::TransferFunction& tf = desk.wish.tf;
    const std::size_t number = *desk.editor.colour;
    const view::ColourPin pin = tf.colour_pins[number];
    const view::ValueScale scale = scale_of(desk);
    const view::Unit unit = shown_unit(desk);
    double at = scale.from_s(unit, pin.at);
    if (labelled_number(desk, "colour at", at, true)) {
        model::move_colour(tf, number, scale.to_s(unit, at));
    }
    ImGui::BeginDisabled(tf.colour_pins.size() == 1);
    const bool deletes = delete_button(desk);
    ImGui::EndDisabled();
    float rgb[3] = {static_cast<float>(pin.rgb.r), static_cast<float>(pin.rgb.g),
                    static_cast<float>(pin.rgb.b)};
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (ImGui::ColorEdit3(
            "##rgb", rgb,
            ImGuiColorEditFlags_Uint8 | ImGuiColorEditFlags_DisplayRGB | ImGuiColorEditFlags_InputRGB)) {
        model::set_colour(tf, number, {double{rgb[0]}, double{rgb[1]}, double{rgb[2]}});
        desk.dragging = ImGui::IsMouseDown(ImGuiMouseButton_Left);
    }
    desk.controls.note("editor/rgb");
    if (deletes) {
        delete_selected(desk);
    }
}

void density(Desk& desk) {
    double& density = desk.wish.tf.density;
    float k = static_cast<float>(density);
    const float number = desk.px(62);
    ImGui::AlignTextToFramePadding();
    small_text(desk, theme::muted, "density");
    ImGui::SameLine(desk.px(50));
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - number - desk.px(6));
    if (ImGui::SliderFloat(
            "##density", &k, 0.01F, 100, "",
            ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat)) {
        density = static_cast<double>(k);
        desk.dragging = ImGui::IsItemActive();
    }
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("multiplies the extinction of all pins; a right click makes it 1");
    }
    if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) {
        density = 1;
    }
    desk.controls.note("editor/density");
    ImGui::SameLine(0, desk.px(6));
    ImGui::SetNextItemWidth(number);
    if (double typed = density; number_field(desk, "##density typed", typed)) {
        density = std::clamp(typed, view::TransferFunction::min_density, view::TransferFunction::max_density);
    }
    desk.controls.note("editor/field/density");
}

void map_choice(Desk& desk) {
    view::TransferFunction& tf = desk.wish.tf;
    const std::string current = view::colour_map_name(tf.colour_pins);
    const std::string suffix = current.ends_with("-r") ? "-r" : "";
    const float row = ImGui::GetTextLineHeight();
    const float label = desk.px(84);
    const float button = ImGui::CalcTextSize("Reverse").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::AlignTextToFramePadding();
    small_text(desk, theme::muted, "colours");
    ImGui::SameLine(desk.px(50));
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - desk.px(6));
    if (begin_choice(desk, "##map", current.empty() ? "own pins" : current, "editor/map")) {
        for (const std::string& name : view::colour_map_names()) {
            if (ImGui::Selectable(("##" + name).c_str(), name + suffix == current, 0, {desk.px(240), row})) {
                model::choose_map(tf, name + suffix);
                desk.editor.colour.reset();
            }
            desk.controls.note("editor/map/" + name);
            const ImVec2 from = ImGui::GetItemRectMin();
            const ImVec2 to = ImGui::GetItemRectMax();
            ImDrawList& list = *ImGui::GetWindowDrawList();
            list.AddText({from.x + desk.px(4), from.y + (to.y - from.y - row) / 2}, theme::text,
                         name.c_str());
            draw_gradient(list, view::colour_map(name + suffix).value(),
                          {from.x + label, from.y + desk.px(3)}, {to.x - desk.px(4), to.y - desk.px(3)}, 0);
        }
        ImGui::EndCombo();
    }
    ImGui::SameLine(0, desk.px(6));
    if (ImGui::Button("Reverse")) {
        model::reverse_colours(tf);
        desk.editor.colour.reset();
    }
    desk.controls.note("editor/reverse");
}

}  // namespace

void function_fields(Desk& desk) {
    density(desk);
    map_choice(desk);
    ImGui::Dummy({0, desk.px(1)});
    if (desk.editor.pin) {
        pin_fields(desk);
    } else if (desk.editor.colour) {
        colour_fields(desk);
    } else {
        small_text(desk, theme::muted, "Click a pin to change it, or add one with the");
        small_text(desk, theme::muted, "buttons above or by a right click in the plot.");
        small_text(desk, theme::muted, "A double click on the bar adds a colour.");
    }
    if (!desk.editor.message.empty()) {
        ImGui::PushTextWrapPos(0);
        small_text(desk, desk.editor.is_fault ? theme::bad : theme::good, desk.editor.message);
        ImGui::PopTextWrapPos();
    }
}

}  // namespace shearwater::ui
