#include "client/view/picture_area.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "client/view/axes.h"
#include "client/view/box_edges.h"
#include "client/view/crop_handles.h"
#include "client/view/edge_scales.h"
#include "client/view/navigation.h"
#include "client/view/notices.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

constexpr ImGuiWindowFlags bare = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                  ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                  ImGuiWindowFlags_NoBringToFrontOnFocus;

// A size brought within what may be asked for, of one eye.
view::ImageSize within_bounds(const view::ImageSize& size, const Shown& shown) {
    constexpr double max_side = 8192;
    const double max_area = double{1 << 25} / (shown ? 2 : 1);
    const double width = std::clamp(static_cast<double>(size.width), 16.0, max_side);
    const double height = std::clamp(static_cast<double>(size.height), 16.0, max_side);
    const double shrink = std::min(1.0, std::sqrt(max_area / (width * height)));
    return {static_cast<int>(width * shrink), static_cast<int>(height * shrink)};
}

// The display's pixels of a size in window coordinates, within those bounds.
view::ImageSize picture_size(ImVec2 size, const Shown& shown) {
    const ImVec2 per_point = ImGui::GetIO().DisplayFramebufferScale;
    return within_bounds({static_cast<int>(size.x * per_point.x), static_cast<int>(size.y * per_point.y)},
                         shown);
}

// A last picture, kept in proportion where its size is not that of the area (yet).
void draw_picture(const Desk& desk, const Texture& picture, const EyeArea& in) {
    if (picture.empty()) {
        return;
    }
    const EyeArea shown = fitted(in.from, in.size, {picture.width(), picture.height()});
    const bool live = desk.status.connection == model::Connection::connected;
    const ImU32 tint = live ? IM_COL32_WHITE : IM_COL32(150, 150, 150, 255);
    // NOLINTNEXTLINE(performance-no-int-to-ptr): so ImGui's handle of a texture is made
    const auto texture = reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture.id()));
    const ImVec2 to{shown.from.x + shown.size.x, shown.from.y + shown.size.y};
    ImGui::GetWindowDrawList()->AddImage(texture, shown.from, to, {0, 0}, {1, 1}, tint);
}

// What `draw` does is seen by those eyes that see the area.
template <class Draw>
void seen_in(Desk& desk, const EyeArea& area, const Draw& draw) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (area.only) {
        desk.gates.only(list, *area.only);
    }
    draw();
    if (area.only) {
        EyeGates::both(list);
    }
}

// Both eyes' pictures are one where they are not in one place.
void draw_pictures(Desk& desk, const std::vector<EyeArea>& areas, const EyeArea& whole) {
    if (desk.shown != image::StereoMode::quad_buffered) {
        draw_picture(desk, desk.picture, whole);
        return;
    }
    seen_in(desk, areas[0], [&] { draw_picture(desk, desk.picture, areas[0]); });
    seen_in(desk, areas[1], [&] { draw_picture(desk, desk.right_picture, areas[1]); });
}

// Of an area, what pictures may fill: with a window for each eye those say what shape they have.
EyeArea picture_place(const Desk& desk, ImVec2 from, ImVec2 size) {
    return desk.eye_window ? fitted(from, size, *desk.eye_window) : EyeArea{from, size, {}};
}

// What is drawn over each picture that is one eye's alone.
void over_pictures(Desk& desk, const std::vector<EyeArea>& areas, const EyeArea& axes) {
    if (!desk.has_cube() || desk.picture.empty()) {
        return;
    }
    const view::Camera camera = view::camera(desk.wish.viewpoint, desk.lattice());
    const std::vector<view::Camera> eyes = cameras_of_areas(desk.shown, camera, desk.eyes);
    for (std::size_t n = 0; n < eyes.size(); ++n) {
        seen_in(desk, areas[n], [&] {
            draw_missing(desk, areas[n], eyes[n]);
            if (desk.boxed || desk.cropping) {
                draw_box_edges(desk, areas[n], eyes[n]);
            }
            if (desk.boxed) {
                // Both eyes see the same numbers, though the axes are in the way of one.
                const ImVec2 aside{axes.from.x + areas[n].from.x - areas[0].from.x,
                                   axes.from.y + areas[n].from.y - areas[0].from.y};
                draw_edge_scales(desk, areas[n], eyes[n], {aside, axes.size, {}}, n == 0);
            }
            if (desk.cropping) {
                crop_handles(desk, areas[n], eyes[n], static_cast<int>(n));
            }
        });
    }
}

std::string view_text(const Desk& desk) {
    const model::Viewpoint& viewpoint = desk.wish.viewpoint;
    std::string words = desk.flying ? "flying  " : "";
    words +=
        fmt::format("az {:.0f}\u00b0  el {:.0f}\u00b0", viewpoint.orbit.azimuth, viewpoint.orbit.elevation);
    if (viewpoint.orbit.roll != 0) {
        words += fmt::format("  roll {:.0f}\u00b0", viewpoint.orbit.roll);
    }
    if (!desk.picture.empty()) {
        words += fmt::format("   {} \u00d7 {}", desk.picture.width(), desk.picture.height());
    }
    return words;
}

// How well the picture is drawn that is seen, and whether a better one is on its way.
struct QualityMark {
    std::string words;
    ImU32 colour;
};
QualityMark quality_mark(const Desk& desk) {
    if (std::string words = desk.status.first_look(); !words.empty()) {
        return {std::move(words), theme::busy};
    }
    constexpr const char* qualities[] = {"draft", "normal", "high"};
    const std::string name = qualities[static_cast<int>(desk.picture_quality)];
    if (desk.status.refining) {
        return {name + ", refining", theme::busy};
    }
    return {name, desk.picture_quality == desk.best_quality() ? theme::good : theme::vacant};
}

// The right end of the status line, from right to left: quality, view. Returns where it begins.
float view_line(const Desk& desk, float right, float y) {
    if (!desk.picture.empty()) {
        const QualityMark mark = quality_mark(desk);
        // The place of the longest, so that nothing else moves when it changes.
        const bool first_look = desk.status.frame && desk.status.frame->sketch;
        right -= ImGui::CalcTextSize(first_look ? "first look, 100 % loaded" : "normal, refining").x;
        ImGui::SetCursorScreenPos({right, y});
        text(theme::muted, mark.words);
        right -= desk.px(14);
        ImGui::SetCursorScreenPos({right, y});
        dot(desk, mark.colour);
        right -= desk.px(14);
    }
    const std::string view = view_text(desk);
    right -= ImGui::CalcTextSize(view.c_str()).x;
    ImGui::SetCursorScreenPos({right, y});
    text(theme::muted, view);
    return right;
}

}  // namespace

void picture_area(Desk& desk, ImVec2 from, ImVec2 size) {
    const EyeArea place = picture_place(desk, from, size);
    const std::vector<EyeArea> areas = eye_areas(desk.shown, place.from, place.size);
    const view::ImageSize pixels = desk.eye_window ? within_bounds(*desk.eye_window, desk.shown)
                                                   : picture_size(areas.front().size, desk.shown);
    desk.dragging = desk.dragging || (pixels != desk.wish.size && !desk.picture.empty());
    desk.wish.size = pixels;
    ImGui::SetNextWindowPos(from);
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::backdrop);
    ImGui::Begin("picture area", nullptr, bare | ImGuiWindowFlags_NoScrollWithMouse);
    draw_pictures(desk, areas, place);
    const EyeArea axes = axes_area(desk, from, size);
    over_pictures(desk, areas, axes);
    navigate_by_mouse(desk, areas, from, size);
    draw_reading(desk);
    if (!desk.picture.empty()) {
        draw_axes(desk, axes);
    }
    notices(desk, from, size);
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    offers(desk, from, size);
}

void status_line(const Desk& desk, ImVec2 from, ImVec2 size) {
    ImGui::SetNextWindowPos(from);
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {desk.px(12), 0});
    ImGui::Begin("status", nullptr, bare);
    ImGui::PushFont(desk.fonts.small);
    const float y = from.y + (size.y - ImGui::GetTextLineHeight()) / 2;
    const float view_x = view_line(desk, from.x + size.x - desk.px(12), y);
    ImGui::SetCursorScreenPos({from.x + desk.px(12), y});
    ImGui::PushClipRect(from, {view_x - desk.px(12), from.y + size.y}, true);
    const bool says = ImGui::GetTime() < desk.saying.until;
    text(!says                ? theme::muted
         : desk.saying.is_bad ? theme::bad
                              : theme::text,
         says ? desk.saying.words : desk.status.words);
    ImGui::PopClipRect();
    ImGui::PopFont();
    ImGui::End();
    ImGui::PopStyleVar(2);
}

}  // namespace shearwater::ui
