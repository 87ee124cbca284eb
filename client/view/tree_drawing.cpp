#include "client/view/tree_drawing.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "client/view/widgets.h"
#include "protocol/wire/words.h"

namespace shearwater::ui {

namespace pb = wire::pb;

namespace {

// A node's middle in the drawing, 0 to 1 across, and its parent among the nodes, or itself.
struct Spot {
    float across;
    std::size_t parent;
};

// Leaves lie evenly, and every other node over the middle of its children. Nodes come before their children.
std::vector<Spot> lay_out(const std::vector<model::Node>& nodes) {
    std::vector<Spot> spots(nodes.size());
    std::vector<std::size_t> above;  // of the node before, from the top
    std::vector<std::size_t> leaves;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto depth = static_cast<std::size_t>(std::max(nodes[i].depth, 0));
        above.resize(std::min(above.size(), depth));
        spots[i].parent = above.empty() ? i : above.back();
        above.push_back(i);
        const bool is_leaf = i + 1 == nodes.size() || nodes[i + 1].depth <= nodes[i].depth;
        if (is_leaf) {
            leaves.push_back(i);
        }
    }
    for (std::size_t n = 0; n < leaves.size(); ++n) {
        spots[leaves[n]].across =
            (static_cast<float>(n) + 0.5F) / static_cast<float>(std::max<std::size_t>(1, leaves.size()));
    }
    for (std::size_t i = nodes.size(); i-- > 0;) {
        float least = 2, most = -1;
        for (std::size_t child = i + 1; child < nodes.size() && nodes[child].depth > nodes[i].depth;
             ++child) {
            if (spots[child].parent == i) {
                least = std::min(least, spots[child].across);
                most = std::max(most, spots[child].across);
            }
        }
        spots[i].across = most >= 0 ? (least + most) / 2 : spots[i].across;
    }
    return spots;
}

std::string short_name(const model::Node& node) {
    return node.depth == 0 ? "server" : fmt::format("{} {}", wire::text_of(node.role), node.place);
}

void draw_node(Desk& desk, const model::Node& node, ImVec2 middle, ImVec2 size) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 from{middle.x - size.x / 2, middle.y - size.y / 2};
    const ImVec2 to{from.x + size.x, from.y + size.y};
    const bool loading = node.phase == pb::PHASE_COUNTING || node.phase == pb::PHASE_LOADING;
    list.AddRectFilled(from, to, theme::well, desk.px(3));
    if (loading) {
        const float done = size.x * static_cast<float>(std::clamp(node.fraction, 0.0, 1.0));
        list.AddRectFilled(from, {from.x + done, to.y}, IM_COL32(240, 180, 80, 60), desk.px(3));
    }
    const bool under = ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(from, to);
    list.AddRect(from, to, under ? theme::text : colour_of_phase(node.phase), desk.px(3), 0, desk.px(1.2F));
    list.PushClipRect(from, to, true);
    ImFont* const font = desk.fonts.small;
    const std::string name = short_name(node);
    const std::string memory =
        node.memory_bytes > 0 ? bytes_text(static_cast<double>(node.memory_bytes)) : std::string();
    const bool two_lines = !memory.empty() && size.y > 2.3F * font->FontSize;
    const auto centred = [&](const std::string& words, float y, ImU32 colour) {
        const float width = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, words.c_str()).x;
        list.AddText(font, font->FontSize, {middle.x - std::min(width, size.x - desk.px(6)) / 2, y}, colour,
                     words.c_str());
    };
    if (size.x > desk.px(44)) {
        centred(name, two_lines ? middle.y - font->FontSize : middle.y - font->FontSize / 2, theme::text);
        if (two_lines) {
            centred(memory, middle.y, theme::muted);
        }
    }
    list.PopClipRect();
    desk.controls.note("machine/node/" + std::to_string(node.place), middle);
    if (under) {
        node_tooltip(node);
    }
}

}  // namespace

ImU32 colour_of_phase(pb::Phase phase) {
    switch (phase) {
        case pb::PHASE_VACANT:
            return theme::vacant;
        case pb::PHASE_READY:
            return theme::good;
        case pb::PHASE_FAILED:
            return theme::bad;
        default:
            return theme::busy;
    }
}

void node_tooltip(const model::Node& node) {
    const std::string memory =
        node.memory_bytes > 0 ? bytes_text(static_cast<double>(node.memory_bytes)) : "-";
    ImGui::SetTooltip("%s\n%s, place %u, %s\nbox %s\nmemory %s%s%s", node.name.c_str(),
                      std::string(wire::text_of(node.role)).c_str(), node.place,
                      std::string(wire::text_of(node.phase)).c_str(), volume::to_string(node.box).c_str(),
                      memory.c_str(), node.error.empty() ? "" : "\n", node.error.c_str());
}

void draw_tree(Desk& desk, ImVec2 from, ImVec2 size) {
    const std::vector<model::Node>& nodes = desk.status.tree.nodes;
    if (nodes.empty()) {
        return;
    }
    const std::vector<Spot> spots = lay_out(nodes);
    int deepest = 0;
    std::size_t leaves = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        deepest = std::max(deepest, nodes[i].depth);
        leaves += i + 1 == nodes.size() || nodes[i + 1].depth <= nodes[i].depth ? 1 : 0;
    }
    const float row = size.y / static_cast<float>(deepest + 1);
    const float column = size.x / static_cast<float>(std::max<std::size_t>(1, leaves));
    const ImVec2 box{std::clamp(column - desk.px(8), desk.px(4), desk.px(104)),
                     std::clamp(row - desk.px(16), desk.px(10), desk.px(34))};
    const auto middle = [&](std::size_t i) {
        return ImVec2{from.x + size.x * spots[i].across,
                      from.y + row * (static_cast<float>(nodes[i].depth) + 0.5F)};
    };
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (spots[i].parent != i) {
            list.AddLine(middle(spots[i].parent), middle(i), theme::line, desk.px(1.2F));
        }
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        draw_node(desk, nodes[i], middle(i), box);
    }
}

}  // namespace shearwater::ui
