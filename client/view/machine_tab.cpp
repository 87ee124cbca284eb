#include "client/view/machine_tab.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "client/view/tree_drawing.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

struct Stage {
    const char* label;
    double model::Stages::*seconds;
    ImU32 colour;
};
constexpr std::array stages{
    Stage{"look", &model::Stages::look, IM_COL32(232, 116, 116, 255)},
    Stage{"render", &model::Stages::render, IM_COL32(86, 156, 255, 255)},
    Stage{"composite", &model::Stages::composite, IM_COL32(88, 196, 128, 255)},
    Stage{"warp", &model::Stages::warp, IM_COL32(240, 180, 80, 255)},
    Stage{"code", &model::Stages::code, IM_COL32(200, 120, 220, 255)},
    Stage{"link", &model::Stages::link, IM_COL32(139, 147, 161, 255)},
};

// A bar for each, all on one scale that reaches to a round time.
void draw_stages(const Desk& desk, const model::Stages& of, ImVec2 from, ImVec2 size) {
    double longest = 1e-3;
    for (const Stage& stage : stages) {
        longest = std::max(longest, of.*stage.seconds);
    }
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImFont* const font = desk.fonts.small;
    const float label_width = desk.px(76), time_width = desk.px(60);
    const float row = size.y / static_cast<float>(stages.size());
    const float bar = std::min(row * 0.62F, desk.px(18));
    float y = from.y;
    for (const Stage& stage : stages) {
        const double seconds = of.*stage.seconds;
        const float middle = y + row / 2;
        const float text_y = middle - font->FontSize / 2;
        list.AddText(font, font->FontSize, {from.x, text_y}, theme::muted, stage.label);
        const float left = from.x + label_width;
        const float room = size.x - label_width - time_width;
        const float width = room * static_cast<float>(seconds / longest);
        list.AddRectFilled({left, middle - bar / 2}, {left + room, middle + bar / 2}, theme::well,
                           desk.px(2));
        list.AddRectFilled({left, middle - bar / 2}, {left + std::max(width, desk.px(1)), middle + bar / 2},
                           stage.colour, desk.px(2));
        const std::string time = fmt::format("{:.1f} ms", seconds * 1e3);
        list.AddText(font, font->FontSize, {left + room + desk.px(8), text_y}, theme::text, time.c_str());
        y += row;
    }
}

// Left out where there is no room for all of it.
void figure(const std::string& words, float gap) {
    if (ImGui::CalcTextSize(words.c_str()).x <= ImGui::GetContentRegionAvail().x) {
        text(theme::muted, words);
        ImGui::SameLine(0, gap);
    }
}

}  // namespace

void machine_tools(Desk& desk) {
    const model::Status& status = desk.status;
    const auto& frame = status.frame;
    const float gap = desk.px(18);
    ImGui::AlignTextToFramePadding();
    if (!frame) {
        figure("no picture yet", gap);
        return;
    }
    const model::Rates& rates = status.rates;
    figure(rates.frames_per_second > 0 ? fmt::format("{:.1f} frames/s", rates.frames_per_second) : "at rest",
           gap);
    figure(fmt::format("{:.0f} ms from view to picture", rates.latency_seconds * 1e3), gap);
    if (frame->stages.render > 0) {
        figure(fmt::format("{:.0f} M samples/s",
                           static_cast<double>(frame->samples) / frame->stages.render / 1e6),
               gap);
    }
    figure(bytes_text(static_cast<double>(frame->bytes)) + " a frame", gap);
    if (status.link_speed) {
        figure(bytes_text(*status.link_speed) + "/s link", gap);
    }
    if (frame->culled_bricks > 0) {
        figure(fmt::format("{:.0f} % hidden",
                           100.0 * static_cast<double>(frame->culled_bricks) /
                               static_cast<double>(std::max<std::uint64_t>(frame->opaque_bricks, 1))),
               gap);
    }
}

void machine_body(Desk& desk) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float left = std::min(desk.px(320), room.x / 2);
    if (desk.status.frame) {
        draw_stages(desk, desk.status.frame->stages, from, {left, room.y});
    }
    const float gap = desk.px(20);
    draw_tree(desk, {from.x + left + gap, from.y}, {room.x - left - gap, room.y});
}

}  // namespace shearwater::ui
