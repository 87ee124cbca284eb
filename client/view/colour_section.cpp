#include "client/model/look.h"
#include "client/view/ramp_editor.h"
#include "client/view/sections.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

void choose_map(Desk& desk, const std::string& name) {
    if (auto pins = view::colour_map(name)) {
        desk.wish.tf.colour_pins = std::move(*pins);
    }
}

void map_choice(Desk& desk, const std::string& current, const std::string& suffix) {
    const float row = ImGui::GetTextLineHeight();
    const float label = desk.px(84);
    const std::string shown = current.empty() ? "own pins" : current;
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (!ImGui::BeginCombo("##map", shown.c_str(), ImGuiComboFlags_HeightLargest)) {
        return;
    }
    if (desk.escape) {
        ImGui::CloseCurrentPopup();
    }
    for (const std::string& name : view::colour_map_names()) {
        if (ImGui::Selectable(("##" + name).c_str(), name + suffix == current, 0, {0, row})) {
            choose_map(desk, name + suffix);
        }
        const ImVec2 from = ImGui::GetItemRectMin();
        const ImVec2 to = ImGui::GetItemRectMax();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddText({from.x + desk.px(4), from.y + (to.y - from.y - row) / 2}, theme::text, name.c_str());
        draw_gradient(list, view::colour_map(name + suffix).value(), {from.x + label, from.y + desk.px(3)},
                      {to.x - desk.px(4), to.y - desk.px(3)}, 0);
    }
    ImGui::EndCombo();
}

}  // namespace

void colour_section(Desk& desk) {
    if (!section(desk, "TRANSFER FUNCTION")) {
        return;
    }
    const std::string current = model::map_name_of(desk.wish.tf.colour_pins);
    bool reversed = current.ends_with("-r");
    map_choice(desk, current, reversed ? "-r" : "");
    ramp_editor(desk);
    ImGui::BeginDisabled(current.empty());
    if (ImGui::Checkbox("reversed colours", &reversed)) {
        choose_map(desk, reversed ? current + "-r" : current.substr(0, current.size() - 2));
    }
    ImGui::EndDisabled();
}

}  // namespace shearwater::ui
