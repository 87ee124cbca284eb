#include "client/view/tree_list.h"

#include <fmt/core.h>

#include <algorithm>

#include "client/view/tree_drawing.h"
#include "client/view/widgets.h"
#include "protocol/wire/words.h"

namespace shearwater::ui {

namespace {

namespace pb = wire::pb;

void node_line(const Desk& desk, const model::Node& node) {
    const float line_start = ImGui::GetCursorScreenPos().y;
    const float indent = desk.px(12) * static_cast<float>(std::min(node.depth, 8));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + indent);
    dot(desk, colour_of_phase(node.phase));
    const std::string name = node.name.empty() ? fmt::format("{} {}", wire::text_of(node.role), node.place)
                                               : node.name.substr(0, node.name.find(" ("));
    const bool under_way = node.phase == pb::PHASE_COUNTING || node.phase == pb::PHASE_LOADING;
    const std::string phase(wire::text_of(node.phase));
    const float right = ImGui::GetWindowContentRegionMax().x;
    const float column = under_way ? desk.px(64) : ImGui::CalcTextSize(phase.c_str()).x;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float name_end = ImGui::GetWindowPos().x + right - column - desk.px(10);
    ImGui::PushClipRect({at.x, at.y}, {name_end, at.y + ImGui::GetTextLineHeight()}, true);
    text(node.phase == pb::PHASE_VACANT ? theme::muted : theme::text, name);
    ImGui::PopClipRect();
    ImGui::SameLine(right - column);
    if (under_way) {
        ImGui::SetCursorPosY(ImGui::GetCursorPosY() + ImGui::GetTextLineHeight() / 2 - desk.px(2));
        progress_line(desk, node.fraction, theme::busy, column);
    } else {
        text(node.phase == pb::PHASE_FAILED ? theme::bad : theme::muted, phase);
    }
    const ImVec2 left_top{ImGui::GetWindowPos().x, line_start};
    if (ImGui::IsWindowHovered() &&
        ImGui::IsMouseHoveringRect(left_top, {left_top.x + right, line_start + ImGui::GetTextLineHeight()})) {
        node_tooltip(node);
    }
}

}  // namespace

void tree_list(Desk& desk) {
    if (!section(desk, "TREE")) {
        return;
    }
    const model::Tree& tree = desk.status.tree;
    if (tree.nodes.empty()) {
        text(theme::muted, "not known yet");
        return;
    }
    small_text(desk, theme::muted,
               fmt::format("{} nodes, {} ready", tree.nodes.size(), tree.in_phase(pb::PHASE_READY)));
    const float room = ImGui::GetContentRegionAvail().y;
    ImGui::BeginChild("tree", {0, std::max(room, desk.px(48))}, false);
    ImGui::PushFont(desk.fonts.small);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(tree.nodes.size()), ImGui::GetTextLineHeightWithSpacing());
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            node_line(desk, tree.nodes[static_cast<std::size_t>(i)]);
        }
    }
    ImGui::PopFont();
    ImGui::EndChild();
}

}  // namespace shearwater::ui
