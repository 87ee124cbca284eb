#include <fmt/core.h>

#include <cmath>

#include "client/view/sections.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

void figure(const Desk& desk, const std::string& value, const char* unit, float x) {
    ImGui::SetCursorPosX(x);
    ImGui::BeginGroup();
    ImGui::PushFont(desk.fonts.bold);
    ImGui::TextUnformatted(value.c_str());
    ImGui::PopFont();
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - desk.px(5));
    small_text(desk, theme::muted, unit);
    ImGui::EndGroup();
}

std::string latency_text(double seconds) {
    return seconds < 0.9995 ? fmt::format("{:.0f} ms", seconds * 1000) : fmt::format("{:.1f} s", seconds);
}

void speed(const Desk& desk) {
    const model::Rates& rates = desk.status.rates;
    const bool any = desk.status.frame.has_value();
    const float left = ImGui::GetCursorPosX();
    const float step = ImGui::GetContentRegionAvail().x / 3;
    const bool moving = rates.frames_per_second > 0;
    figure(desk, moving ? fmt::format("{:.1f}", rates.frames_per_second) : "idle", "frames/s", left);
    ImGui::SameLine();
    figure(desk, any ? latency_text(rates.latency_seconds) : "-", "latency", left + step);
    ImGui::SameLine();
    figure(desk, any ? bytes_text(rates.bytes_per_frame) : "-", "a frame", left + 2 * step);
}

// As the view moves, or always the same.
void quality(Desk& desk) {
    std::optional<view::Quality>& fixed = desk.effort.fixed;
    const int held = fixed ? static_cast<int>(*fixed) + 1 : 0;
    const int holds = switch_among(desk, "quality", {"Auto", "Draft", "Normal", "High"}, held);
    fixed = holds > 0 ? std::optional(static_cast<view::Quality>(holds - 1)) : std::nullopt;
    ImGui::BeginDisabled(fixed.has_value());
    float rate = static_cast<float>(desk.effort.target_rate);
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (ImGui::SliderFloat("##rate", &rate, static_cast<float>(model::Effort::min_rate),
                           static_cast<float>(model::Effort::max_rate), "%.0f frames/s",
                           ImGuiSliderFlags_AlwaysClamp)) {
        desk.effort.target_rate = std::round(static_cast<double>(rate));
    }
    desk.controls.note("quality/rate");
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("held while the view moves");
    }
    ImGui::EndDisabled();
}

// A switch, and how much of what has opacity others hide.
void culling_switch(Desk& desk) {
    culling::Settings& wanted = desk.wish.culling;
    bool on = wanted.kind != culling::Kind::off;
    if (ImGui::Checkbox("leave out what is hidden", &on)) {
        wanted.kind = on ? culling::Kind::opof : culling::Kind::off;
    }
    desk.controls.note("quality/culling");
    const auto& frame = desk.status.frame;
    if (on && frame && frame->opaque_bricks > 0) {
        const double share =
            static_cast<double>(frame->culled_bricks) / static_cast<double>(frame->opaque_bricks);
        const std::string text = fmt::format("{:.0f} %", 100 * share);
        ImGui::SameLine(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x -
                        ImGui::CalcTextSize(text.c_str()).x);
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(text.c_str());
    }
}

}  // namespace

void speed_section(Desk& desk) {
    if (!section(desk, "QUALITY AND SPEED")) {
        return;
    }
    quality(desk);
    culling_switch(desk);
    speed(desk);
}

}  // namespace shearwater::ui
