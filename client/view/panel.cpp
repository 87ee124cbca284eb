#include "client/view/panel.h"

#include <fmt/core.h>

#include <cmath>

#include "client/model/look.h"
#include "client/view/ramp_editor.h"
#include "client/view/tree_list.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

using model::Connection;

ImU32 colour_of_link(Connection connection) {
    switch (connection) {
        case Connection::connected:
            return theme::good;
        case Connection::connecting:
        case Connection::waiting:
            return theme::busy;
        case Connection::refused:
            break;
    }
    return theme::bad;
}

const char* word_for_link(Connection connection) {
    switch (connection) {
        case Connection::connected:
            return "connected";
        case Connection::connecting:
            return "connecting";
        case Connection::waiting:
            return "reconnecting";
        case Connection::refused:
            return "refused";
    }
    return "";
}

struct HelpLine {
    const char* input;
    const char* effect;
};
constexpr HelpLine help_lines[] = {
    {"Left drag", "turn"},
    {"Right drag, Shift left drag", "move"},
    {"Wheel", "zoom at the cursor"},
    {"Double click, R", "reset the view"},
    {"P", "perspective or parallel"},
    {"C, Shift C", "next, previous colour map"},
    {"I", "reverse the colour map"},
    {"Arrows, +, -", "turn, zoom"},
    {"Tab", "hide or show this panel"},
    {"Ctrl Q", "quit"},
};

void help(const Desk& desk) {
    ImGui::BeginTooltip();
    for (const HelpLine& line : help_lines) {
        ImGui::TextUnformatted(line.input);
        ImGui::SameLine(desk.px(220));
        text(theme::muted, line.effect);
    }
    ImGui::EndTooltip();
}

void header(Desk& desk) {
    ImGui::PushFont(desk.fonts.bold);
    ImGui::TextUnformatted("Shearwater");
    ImGui::PopFont();
    const float side = ImGui::GetFrameHeight();
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - side);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - desk.px(2));
    ImGui::Button("?", {side, side});
    if (ImGui::IsItemHovered()) {
        help(desk);
    }
    dot(desk, colour_of_link(desk.status.connection));
    text(theme::text, word_for_link(desk.status.connection));
    if (desk.status.connection == Connection::waiting || desk.status.connection == Connection::refused) {
        ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - desk.px(92));
        desk.retry = ImGui::SmallButton("connect now");
    }
}

void cube_section(const Desk& desk) {
    section(desk, "CUBE");
    if (!desk.has_cube()) {
        text(theme::muted, "not known yet");
        return;
    }
    const model::Cube& cube = *desk.status.cube;
    const auto& n = cube.lattice.n;
    text(theme::text, cube.object.empty() ? cube.name : cube.object);
    if (!cube.object.empty()) {
        small_text(desk, theme::muted, cube.name);
    }
    small_text(desk, theme::muted,
               fmt::format("{} \u00d7 {} \u00d7 {} voxels, {} bits", n[0], n[1], n[2], cube.mapping.bits));
    small_text(desk, theme::muted,
               fmt::format("{}{} to {}{}{}, {}", cube.provisional ? "about " : "",
                           value_text(cube.mapping.lo), value_text(cube.mapping.hi),
                           cube.unit.empty() ? "" : " ", cube.unit, volume::name(cube.mapping.stretch)));
}

void camera_section(Desk& desk) {
    section(desk, "CAMERA");
    model::Viewpoint& viewpoint = desk.wish.viewpoint;
    const bool parallel = viewpoint.projection == view::Projection::parallel;
    if (switch_among(desk, {"Perspective", "Parallel"}, parallel ? 1 : 0) != (parallel ? 1 : 0)) {
        model::toggle_projection(viewpoint);
    }
    ImGui::BeginDisabled(parallel || !desk.has_cube());
    float fov = static_cast<float>(viewpoint.fov);
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (ImGui::SliderFloat("##fov", &fov, model::min_fov, model::max_fov, "field of view %.0f\u00b0",
                           ImGuiSliderFlags_AlwaysClamp)) {
        model::set_fov(viewpoint, static_cast<double>(fov), desk.lattice());
        desk.dragging = ImGui::IsItemActive();
    }
    ImGui::EndDisabled();
    if (ImGui::Button("Reset view", {-FLT_MIN, 0})) {
        desk.reset_view();
    }
}

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

void colour_section(Desk& desk) {
    section(desk, "TRANSFER FUNCTION");
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
    section(desk, "QUALITY AND SPEED");
    std::optional<view::Quality>& fixed = desk.effort.fixed;
    const int held = fixed ? static_cast<int>(*fixed) + 1 : 0;
    const int holds = switch_among(desk, {"Auto", "Draft", "Normal", "High"}, held);
    fixed = holds > 0 ? std::optional(static_cast<view::Quality>(holds - 1)) : std::nullopt;
    ImGui::BeginDisabled(fixed.has_value());
    float rate = static_cast<float>(desk.effort.target_rate);
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (ImGui::SliderFloat("##rate", &rate, static_cast<float>(model::Effort::min_rate),
                           static_cast<float>(model::Effort::max_rate), "%.0f frames/s",
                           ImGuiSliderFlags_AlwaysClamp)) {
        desk.effort.target_rate = std::round(static_cast<double>(rate));
    }
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

void panel(Desk& desk, ImVec2 from, ImVec2 size) {
    ImGui::SetNextWindowPos(from);
    ImGui::SetNextWindowSize(size);
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoBringToFrontOnFocus);
    header(desk);
    cube_section(desk);
    camera_section(desk);
    colour_section(desk);
    quality(desk);
    culling_switch(desk);
    speed(desk);
    tree_list(desk);
    ImGui::End();
}

}  // namespace shearwater::ui
