#include "client/view/preset_menu.h"

#include <algorithm>
#include <cstring>

#include "client/view/function_plot.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

void put_name(EditorState& editor, const std::string& name) {
    editor.preset_name = {};
    const std::size_t length = std::min(name.size(), editor.preset_name.size() - 1);
    std::memcpy(editor.preset_name.data(), name.data(), length);
}

void list(Desk& desk) {
    EditorState& editor = desk.editor;
    ImGui::BeginChild("list", {desk.px(300), desk.px(132)}, true);
    if (editor.presets.empty()) {
        small_text(desk, theme::muted, "None yet. Name this one, and save it.");
    }
    for (const std::string& name : editor.presets) {
        if (ImGui::Selectable(name.c_str(), name == editor.preset)) {
            editor.preset = name;
            put_name(editor, name);
            desk.presets.load(name);
        }
        desk.controls.note("editor/preset/" + name);
    }
    ImGui::EndChild();
}

// What its positions are kept by.
void anchor_choice(Desk& desk) {
    const auto words = [](view::Unit unit) {
        constexpr const char* all[] = {"place between the limits", "data value", "percentile",
                                       "sigmas above the median"};
        return all[static_cast<int>(unit)];
    };
    const view::ValueScale scale = scale_of(desk);
    if (!scale.has(desk.editor.anchor)) {
        desk.editor.anchor = view::Unit::value;
    }
    ImGui::AlignTextToFramePadding();
    small_text(desk, theme::muted, "keeps its");
    ImGui::SameLine(desk.px(70));
    ImGui::SetNextItemWidth(desk.px(230));
    if (begin_choice(desk, "##anchor", words(desk.editor.anchor), "editor/anchor")) {
        for (const view::Unit unit :
             {view::Unit::value, view::Unit::percentile, view::Unit::sigma, view::Unit::stretched}) {
            const auto flags = scale.has(unit) ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
            if (ImGui::Selectable(words(unit), unit == desk.editor.anchor, flags)) {
                desk.editor.anchor = unit;
            }
            desk.controls.note("editor/anchor/" + std::string(view::name(unit)));
        }
        ImGui::EndCombo();
    }
}

void buttons(Desk& desk) {
    EditorState& editor = desk.editor;
    const std::string name = editor.preset_name.data();
    const bool is_name = PresetFolder::is_name(name);
    const bool is_there = std::ranges::find(editor.presets, name) != editor.presets.end();
    ImGui::BeginDisabled(!is_name || !desk.has_cube());
    if (ImGui::Button(is_there ? "Replace" : "Save", {desk.px(96), 0})) {
        desk.presets.save(name, view::anchored(desk.wish.tf, editor.anchor, scale_of(desk)));
    }
    ImGui::EndDisabled();
    desk.controls.note("editor/preset-save");
    ImGui::SameLine();
    ImGui::BeginDisabled(editor.preset.empty() || !is_name || is_there);
    if (ImGui::Button("Rename", {desk.px(96), 0})) {
        desk.presets.rename(editor.preset, name);
    }
    ImGui::EndDisabled();
    desk.controls.note("editor/preset-rename");
    ImGui::SameLine();
    ImGui::BeginDisabled(editor.preset.empty());
    if (ImGui::Button("Delete", {desk.px(96), 0})) {
        desk.presets.remove(editor.preset);
        editor.preset.clear();
    }
    ImGui::EndDisabled();
    desk.controls.note("editor/preset-delete");
}

}  // namespace

void preset_menu(Desk& desk) {
    EditorState& editor = desk.editor;
    if (ImGui::Button("Presets")) {
        desk.presets.list();
        editor.anchor = shown_unit(desk);
        editor.message.clear();
        ImGui::OpenPopup("presets");
    }
    desk.controls.note("editor/presets");
    const ImVec2 from = ImGui::GetItemRectMin();
    const ImVec2 to = ImGui::GetItemRectMax();
    ImGui::SetNextWindowPos({to.x, from.y - desk.px(4)}, ImGuiCond_Always, {1, 1});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {desk.px(12), desk.px(12)});
    if (ImGui::BeginPopup("presets")) {
        if (desk.escape) {
            ImGui::CloseCurrentPopup();
        }
        list(desk);
        ImGui::SetNextItemWidth(desk.px(300));
        ImGui::InputTextWithHint("##name", "name", editor.preset_name.data(), editor.preset_name.size(),
                                 ImGuiInputTextFlags_AutoSelectAll);
        desk.controls.note("editor/preset-name");
        anchor_choice(desk);
        buttons(desk);
        ImGui::BeginChild("said", {desk.px(300), desk.px(40)});
        ImGui::PushTextWrapPos(0);
        small_text(desk, editor.is_fault ? theme::bad : theme::good, editor.message);
        ImGui::PopTextWrapPos();
        ImGui::EndChild();
        ImGui::EndPopup();
    }
    ImGui::PopStyleVar();
}

void take_presets(Desk& desk) {
    EditorState& editor = desk.editor;
    while (auto outcome = desk.presets.collect()) {
        editor.presets = std::move(outcome->names);
        if (!outcome->name.empty()) {
            editor.preset = outcome->name;
        }
        editor.message = std::move(outcome->message);
        editor.is_fault = outcome->is_fault;
        if (!outcome->loaded) {
            continue;
        }
        const view::ValueScale scale = scale_of(desk);
        auto tf = view::on_scale(*outcome->loaded, desk.has_cube() ? &scale : nullptr);
        if (tf) {
            desk.wish.tf = *std::move(tf);
            editor.pin.reset();
            editor.colour.reset();
        } else {
            editor.message = tf.error().message();
            editor.is_fault = true;
        }
    }
}

}  // namespace shearwater::ui
