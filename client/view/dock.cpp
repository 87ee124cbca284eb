#include "client/view/dock.h"

#include <iterator>

#include "client/view/function_tab.h"
#include "client/view/machine_tab.h"
#include "client/view/movie_tab.h"

namespace shearwater::ui {

namespace {

struct Tab {
    const char* title;
    float tools_width;     // nominal pixels, at the least
    void (*tools)(Desk&);  // on the line of the tabs, to their right, where there is room; else below
    void (*body)(Desk&);
};
constexpr Tab tabs[] = {
    {"Transfer function", 480, function_tools, function_body},
    {"Movie", 540, movie_tools, movie_body},
    {"Machine", 300, machine_tools, machine_body},
};

void tab_heads(Desk& desk) {
    int i = 0;
    for (const Tab& tab : tabs) {
        const bool holds = i == desk.dock_tab;
        const ImVec2 from = ImGui::GetCursorScreenPos();
        const float width = ImGui::CalcTextSize(tab.title).x + desk.px(16);
        const float height = ImGui::GetFrameHeight();
        if (ImGui::InvisibleButton(tab.title, {width, height})) {
            desk.dock_tab = i;
        }
        desk.controls.note(std::string("dock/") + tab.title);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const ImU32 colour = holds || ImGui::IsItemHovered() ? theme::text : theme::muted;
        list.AddText({from.x + desk.px(8), from.y + (height - ImGui::GetFontSize()) / 2}, colour, tab.title);
        if (holds) {
            list.AddRectFilled({from.x + desk.px(8), from.y + height + desk.px(1)},
                               {from.x + width - desk.px(8), from.y + height + desk.px(3)}, theme::accent,
                               desk.px(1));
        }
        if (++i < static_cast<int>(std::size(tabs))) {
            ImGui::SameLine(0, desk.px(4));
        }
    }
}

}  // namespace

void dock(Desk& desk, ImVec2 from, ImVec2 size) {
    ImGui::SetNextWindowPos(from);
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {desk.px(10), desk.px(6)});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {desk.px(7), desk.px(2)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {desk.px(6), desk.px(5)});
    ImGui::Begin("dock", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus |
                     ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::GetWindowDrawList()->AddLine(from, {from.x + size.x, from.y}, theme::line);
    tab_heads(desk);
    const Tab& tab = tabs[desk.dock_tab];
    ImGui::SameLine(0, desk.px(14));
    if (ImGui::GetContentRegionAvail().x < desk.px(tab.tools_width)) {
        ImGui::NewLine();
    }
    tab.tools(desk);
    ImGui::Dummy({0, 0});
    tab.body(desk);
    ImGui::End();
    ImGui::PopStyleVar(3);
}

}  // namespace shearwater::ui
