#include "client/view/ramp_editor.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "client/model/look.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

// The plot's place on the screen, and the way between it and (value, opacity).
struct Plot {
    ImVec2 from, to;

    float x(double s) const { return from.x + (to.x - from.x) * static_cast<float>(std::clamp(s, 0.0, 1.0)); }
    float y(double a) const { return to.y - (to.y - from.y) * static_cast<float>(std::cbrt(a)); }
    double s_at(float px) const { return std::clamp((px - from.x) / (to.x - from.x), 0.0F, 1.0F); }
    double a_at(float py) const {
        const double up = std::clamp((to.y - py) / (to.y - from.y), 0.0F, 1.0F);
        return up * up * up;
    }
};

void draw_grid(const Desk& desk, ImDrawList& list, const Plot& plot) {
    list.AddRectFilled(plot.from, plot.to, theme::well, desk.px(3));
    struct Mark {
        double opacity;
        const char* label;
    };
    for (const Mark& mark : {Mark{0.001, "0.001"}, Mark{0.01, "0.01"}, Mark{0.1, "0.1"}}) {
        const float y = std::round(plot.y(mark.opacity));
        list.AddLine({plot.from.x, y}, {plot.to.x, y}, IM_COL32(38, 42, 50, 255));
        list.AddText(desk.fonts.small, desk.fonts.small->FontSize * 0.9F,
                     {plot.from.x + desk.px(4), y - desk.fonts.small->FontSize}, IM_COL32(100, 107, 120, 255),
                     mark.label);
    }
}

// The area below the opacity, in the colours it is for, and the opacity itself.
void draw_curve(const Desk& desk, ImDrawList& list, const Plot& plot) {
    const view::TransferFunction& tf = desk.wish.tf;
    std::vector<ImVec2> curve;
    const int columns = std::max(1, static_cast<int>(plot.to.x - plot.from.x));
    for (int i = 0; i <= columns; ++i) {
        const double s = static_cast<double>(i) / columns;
        const ImVec2 at{plot.from.x + static_cast<float>(i), plot.y(tf.opacity(s))};
        if (at.y < plot.to.y && i < columns) {
            list.AddRectFilled(at, {at.x + 1, plot.to.y}, colour_of(tf.colour(s), 0.55));
        }
        curve.push_back(at);
    }
    list.AddPolyline(curve.data(), static_cast<int>(curve.size()), theme::text, 0, desk.px(1.5F));
}

std::array<ImVec2, 2> ends_of(const view::Ramp& ramp, const Plot& plot) {
    return {ImVec2{plot.x(ramp.x0), plot.y(ramp.a0)}, ImVec2{plot.x(ramp.x1), plot.y(ramp.a1)}};
}

// The end within reach of the mouse, the nearer of both, or -1.
int end_under_mouse(const Desk& desk, const std::array<ImVec2, 2>& ends) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    int nearest = -1;
    float least = desk.px(14);
    for (int i = 0; i < 2; ++i) {
        const ImVec2& end = ends[static_cast<std::size_t>(i)];
        const float away = std::hypot(end.x - mouse.x, end.y - mouse.y);
        if (away < least) {
            least = away;
            nearest = i;
        }
    }
    return nearest;
}

view::Ramp moved(view::Ramp ramp, int end, const Plot& plot) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (end == 0) {
        ramp.x0 = std::min(plot.s_at(mouse.x), ramp.x1 - model::min_ramp_width);
        ramp.a0 = plot.a_at(mouse.y);
    } else {
        ramp.x1 = std::max(plot.s_at(mouse.x), ramp.x0 + model::min_ramp_width);
        ramp.a1 = plot.a_at(mouse.y);
    }
    return ramp;
}

void drag_ends(Desk& desk, const Plot& plot, const view::Ramp& ramp) {
    const auto ends = ends_of(ramp, plot);
    const int under = end_under_mouse(desk, ends);
    if (ImGui::IsItemActivated()) {
        desk.ramp_end = under;
    }
    if (!ImGui::IsItemActive()) {
        desk.ramp_end = -1;
    }
    if (desk.ramp_end >= 0) {
        model::set_ramp(desk.wish.tf, moved(ramp, desk.ramp_end, plot));
        desk.dragging = true;
    }
    const int lit = desk.ramp_end >= 0 ? desk.ramp_end : (ImGui::IsItemHovered() ? under : -1);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int i = 0; i < 2; ++i) {
        const ImVec2& end = ends[static_cast<std::size_t>(i)];
        list.AddCircleFilled(end, desk.px(i == lit ? 6.5F : 5), i == lit ? theme::accent : theme::text, 20);
        list.AddCircle(end, desk.px(i == lit ? 6.5F : 5), theme::well, 20, desk.px(1.5F));
    }
    if (lit >= 0) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
        const bool low = lit == 0;
        const double s = low ? ramp.x0 : ramp.x1;
        const double value = desk.has_cube() ? desk.status.cube->mapping.value_of_s(s) : s;
        ImGui::SetTooltip("value %s, opacity %s", value_text(value).c_str(),
                          value_text(low ? ramp.a0 : ramp.a1).c_str());
    }
}

void value_axis(const Desk& desk, const Plot& plot) {
    const bool known = desk.has_cube();
    const std::string low = known ? value_text(desk.status.cube->mapping.lo) : "0";
    const std::string high = known ? value_text(desk.status.cube->mapping.hi) : "1";
    const std::string unit = known ? desk.status.cube->unit : "";
    ImGui::PushFont(desk.fonts.small);
    text(theme::muted, low);
    const float middle = (plot.from.x + plot.to.x - ImGui::CalcTextSize(unit.c_str()).x) / 2;
    ImGui::SameLine();
    ImGui::SetCursorScreenPos({middle, ImGui::GetCursorScreenPos().y});
    text(theme::muted, unit);
    ImGui::SameLine();
    ImGui::SetCursorScreenPos(
        {plot.to.x - ImGui::CalcTextSize(high.c_str()).x, ImGui::GetCursorScreenPos().y});
    text(theme::muted, high);
    ImGui::PopFont();
}

// The ends' opacities as numbers.
void number_fields(Desk& desk, view::Ramp ramp) {
    float low = static_cast<float>(ramp.a0), high = static_cast<float>(ramp.a1);
    const float width = (ImGui::GetContentRegionAvail().x - desk.px(8)) / 2;
    const ImGuiSliderFlags flags = ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp;
    ImGui::SetNextItemWidth(width);
    const bool low_set = ImGui::DragFloat("##low", &low, 0.002F, 0, 1, "from %.4g", flags);
    const bool low_held = ImGui::IsItemActive();
    ImGui::SameLine(0, desk.px(8));
    ImGui::SetNextItemWidth(width);
    const bool high_set = ImGui::DragFloat("##high", &high, 0.002F, 0, 1, "to %.4g", flags);
    if (low_set || high_set) {
        ramp.a0 = low_set ? static_cast<double>(low) : ramp.a0;
        ramp.a1 = high_set ? static_cast<double>(high) : ramp.a1;
        model::set_ramp(desk.wish.tf, ramp);
        desk.dragging = low_held || ImGui::IsItemActive();
    }
}

}  // namespace

void ramp_editor(Desk& desk) {
    const float width = ImGui::GetContentRegionAvail().x;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float inset = desk.px(6);  // room for the handles at the plot's edges
    const Plot plot{{at.x + inset, at.y + inset}, {at.x + width - inset, at.y + desk.px(112)}};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_grid(desk, list, plot);
    draw_curve(desk, list, plot);
    const float bar = desk.px(12);
    draw_gradient(list, desk.wish.tf.colour_pins, {plot.from.x, plot.to.y + desk.px(4)},
                  {plot.to.x, plot.to.y + desk.px(4) + bar}, 0);
    ImGui::InvisibleButton("ramp", {width, plot.to.y - at.y + inset});
    const view::Ramp* ramp = model::ramp_of(desk.wish.tf);
    if (ramp != nullptr) {
        drag_ends(desk, plot, view::Ramp(*ramp));
    }
    ImGui::SetCursorScreenPos({plot.from.x, plot.to.y + desk.px(8) + bar});
    value_axis(desk, plot);
    if (ramp != nullptr) {
        small_text(desk, theme::muted, "Opacity of one unit of length");
        number_fields(desk, *model::ramp_of(desk.wish.tf));
    }
}

}  // namespace shearwater::ui
