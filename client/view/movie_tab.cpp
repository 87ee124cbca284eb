#include "client/view/movie_tab.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

void show(Desk& desk, const flight::Seen& seen) {
    desk.steer() = seen.viewpoint;
    desk.wish.tf = seen.tf;
    desk.wish.scaling = seen.scaling;
}

bool tool(Desk& desk, const char* label, bool enabled, const char* tip) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(label);
    ImGui::EndDisabled();
    desk.controls.note(std::string("movie/") + label);
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
        ImGui::SetTooltip("%s", tip);
    }
    ImGui::SameLine();
    return pressed;
}

void file_tools(Desk& desk) {
    const float buttons = 2 * desk.px(58);
    const float width = std::min(desk.px(300), ImGui::GetContentRegionAvail().x - buttons);
    if (width < desk.px(80)) {
        return;
    }
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - buttons - width);
    ImGui::SetNextItemWidth(width);
    ImGui::InputTextWithHint("##flight", "a file for the flight path", desk.movie.file.data(),
                             desk.movie.file.size(), ImGuiInputTextFlags_AutoSelectAll);
    desk.controls.note("movie/file");
    ImGui::SameLine();
    const std::string file = desk.movie.file.data();
    if (tool(desk, "Save", !desk.timeline.empty() && !file.empty(), "keep the flight path in the file")) {
        desk.flights.save(file, desk.timeline.path());
    }
    if (tool(desk, "Open", !file.empty(), "read the file's flight path")) {
        desk.flights.open(file);
    }
}

// The strip's place on the screen, and the way between it and the time.
struct Strip {
    ImVec2 from, to;
    double span;  // seconds

    float x(double time) const { return from.x + (to.x - from.x) * static_cast<float>(time / span); }
    double time_at(float px) const { return static_cast<double>((px - from.x) / (to.x - from.x)) * span; }
};

// Seconds between marks, some 60 nominal pixels apart.
double mark_step(const Desk& desk, const Strip& strip) {
    const double least = strip.span * static_cast<double>(desk.px(60) / (strip.to.x - strip.from.x));
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (step * power >= least) {
            return step * power;
        }
    }
    return 10 * power;
}

void draw_ruler(const Desk& desk, ImDrawList& list, const Strip& strip) {
    list.AddRectFilled(strip.from, strip.to, theme::well, desk.px(3));
    const double step = mark_step(desk, strip);
    for (int i = 0; i * step <= strip.span; ++i) {
        const float x = std::round(strip.x(i * step));
        list.AddLine({x, strip.from.y}, {x, strip.to.y}, IM_COL32(34, 37, 45, 255));
        const std::string label = fmt::format("{:g} s", i * step);
        const float width =
            desk.fonts.small->CalcTextSizeA(desk.fonts.small->FontSize, FLT_MAX, 0, label.c_str()).x;
        if (x + desk.px(4) + width < strip.to.x) {
            list.AddText(desk.fonts.small, desk.fonts.small->FontSize,
                         {x + desk.px(4), strip.from.y + desk.px(2)}, theme::muted, label.c_str());
        }
    }
}

// How a number of the camera goes along the flight, in the strip's height.
void draw_curve(const Desk& desk, ImDrawList& list, const Strip& strip, float top, ImU32 colour,
                double (*value)(const view::Viewpoint&, const view::Lattice&)) {
    const model::Timeline& timeline = desk.timeline;
    constexpr int points = 160;
    std::vector<double> values;
    for (int i = 0; i <= points; ++i) {
        const auto seen = flight::seen_at(timeline.path(), timeline.duration() * i / points, desk.lattice());
        values.push_back(value(seen.viewpoint, desk.lattice()));
    }
    const auto [least, most] = std::ranges::minmax_element(values);
    const double range = *most - *least;
    const float bottom = strip.to.y - desk.px(8);
    std::vector<ImVec2> line;
    for (int i = 0; i <= points; ++i) {
        const double share =
            range > 1e-9 * std::abs(*most) ? (values[static_cast<std::size_t>(i)] - *least) / range : 0.5;
        line.push_back(
            {strip.x(timeline.duration() * i / points), bottom - (bottom - top) * static_cast<float>(share)});
    }
    list.AddPolyline(line.data(), static_cast<int>(line.size()), colour, 0, desk.px(1.3F));
}

struct Curve {
    const char* label;
    ImU32 colour;
    double (*value)(const view::Viewpoint&, const view::Lattice&);
};
constexpr Curve curves[] = {
    {"azimuth", IM_COL32(86, 156, 255, 200),
     [](const view::Viewpoint& v, const view::Lattice&) { return v.orbit.azimuth; }},
    {"elevation", IM_COL32(88, 196, 128, 200),
     [](const view::Viewpoint& v, const view::Lattice&) { return v.orbit.elevation; }},
    {"distance", IM_COL32(240, 180, 80, 200),
     [](const view::Viewpoint& v, const view::Lattice& lattice) { return view::distance_of(v, lattice); }},
};

void draw_curves(const Desk& desk, ImDrawList& list, const Strip& strip, float top) {
    if (desk.timeline.path().keys.size() < 2 || !desk.has_cube()) {
        return;
    }
    list.PushClipRect(strip.from, strip.to, true);
    for (const Curve& curve : curves) {
        draw_curve(desk, list, strip, top, curve.colour, curve.value);
    }
    list.PopClipRect();
}

void diamond(ImDrawList& list, ImVec2 at, float r, ImU32 colour) {
    list.AddQuadFilled({at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r}, {at.x - r, at.y}, colour);
}

// The key whose mark the mouse is at.
std::optional<std::size_t> key_under_mouse(const Desk& desk, const Strip& strip, float lane) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    std::optional<std::size_t> nearest;
    float least = desk.px(9);
    const auto& keys = desk.timeline.path().keys;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const float away = std::hypot(strip.x(keys[i].time) - mouse.x, lane - mouse.y);
        if (away < least) {
            least = away;
            nearest = i;
        }
    }
    return nearest;
}

void draw_keys(Desk& desk, ImDrawList& list, const Strip& strip, float lane,
               const std::optional<std::size_t>& under) {
    const auto& keys = desk.timeline.path().keys;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const ImVec2 at{strip.x(keys[i].time), lane};
        const bool selected = desk.timeline.selected() == i;
        diamond(list, at, desk.px(selected || under == i ? 7.5F : 6), theme::well);
        diamond(list, at, desk.px(selected || under == i ? 6 : 4.5F), selected ? theme::accent : theme::text);
        desk.controls.note(fmt::format("movie/key/{}", i + 1), at);
    }
    const float x = strip.x(desk.timeline.at());
    list.AddLine({x, strip.from.y}, {x, strip.to.y}, theme::accent, desk.px(1.5F));
    list.AddTriangleFilled({x - desk.px(5), strip.from.y}, {x + desk.px(5), strip.from.y},
                           {x, strip.from.y + desk.px(7)}, theme::accent);
    desk.controls.note("movie/needle", {x, strip.from.y + desk.px(4)});
}

// A key is taken along, or the needle goes to the mouse and the view with it.
void drag(Desk& desk, const Strip& strip, const std::optional<std::size_t>& under) {
    model::Timeline& timeline = desk.timeline;
    if (ImGui::IsItemActivated()) {
        desk.movie.holds_key = under.has_value();
        if (under) {
            timeline.select(*under);
        }
    } else if (!ImGui::IsItemActive()) {
        return;
    }
    const bool moved = ImGui::IsMouseDragging(ImGuiMouseButton_Left, desk.px(2));
    if (desk.movie.holds_key && moved) {
        timeline.move_selected(strip.time_at(ImGui::GetIO().MousePos.x));
    } else if (!desk.movie.holds_key) {
        timeline.seek(strip.time_at(ImGui::GetIO().MousePos.x));
    }
    if (desk.has_cube() && (moved || ImGui::IsItemActivated())) {
        if (const auto seen = timeline.seen(desk.lattice())) {
            show(desk, *seen);
        }
    }
}

void legend(const Desk& desk) {
    const model::Timeline& timeline = desk.timeline;
    ImGui::PushFont(desk.fonts.small);
    if (timeline.empty()) {
        text(theme::muted,
             "Look at what the movie begins with and press Key; then seek, turn, and press it again.");
    } else {
        text(theme::muted, fmt::format("{} keys, {:.2f} s, {} frames", timeline.path().keys.size(),
                                       timeline.duration(), timeline.path().frames()));
        for (const Curve& curve : curves) {
            ImGui::SameLine(0, desk.px(14));
            text(curve.colour | IM_COL32(0, 0, 0, 255), curve.label);
        }
        ImGui::SameLine(0, desk.px(14));
        text(theme::muted, "Drawn by: shearwater movie FILE CUBE -o film.mp4");
    }
    ImGui::PopFont();
}

}  // namespace

void movie_tools(Desk& desk) {
    model::Timeline& timeline = desk.timeline;
    if (tool(desk, "Key", desk.has_cube(), "a key frame of the view, where the needle is")) {
        timeline.keep({desk.wish.viewpoint, desk.wish.tf, desk.wish.scaling});
    }
    const bool plays = timeline.playing();
    if (tool(desk, plays ? "Pause" : "Play", timeline.path().keys.size() > 1 && desk.has_cube(),
             "fly from the needle on")) {
        if (plays) {
            timeline.pause();
        } else {
            timeline.play(desk.now);
        }
    }
    if (tool(desk, "Delete", timeline.selected().has_value(), "the selected key")) {
        timeline.remove_selected();
    }
    double at = timeline.at();
    ImGui::SetNextItemWidth(desk.px(64));
    if (number_field(desk, "##at", at)) {
        timeline.seek(at);
    }
    desk.controls.note("movie/at");
    ImGui::SameLine(0, desk.px(4));
    text(theme::muted, "s");
    ImGui::SameLine();
    double fps = timeline.path().fps;
    ImGui::SetNextItemWidth(desk.px(44));
    if (number_field(desk, "##fps", fps)) {
        timeline.set_fps(static_cast<int>(std::clamp(std::round(fps), 1.0, 240.0)));
    }
    desk.controls.note("movie/fps");
    ImGui::SameLine(0, desk.px(4));
    text(theme::muted, "frames/s");
    ImGui::SameLine();
    file_tools(desk);
}

void movie_body(Desk& desk) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float legend_height = desk.px(20);
    const float inset = desk.px(8);
    const ImVec2 size{room.x, std::max(room.y - legend_height, desk.px(40))};
    const Strip strip{{at.x + inset, at.y}, {at.x + size.x - inset, at.y + size.y}, desk.timeline.span()};
    const float lane = strip.from.y + desk.px(30);
    ImGui::InvisibleButton("strip", size);
    desk.controls.note("movie/strip");
    const auto under = ImGui::IsItemHovered() ? key_under_mouse(desk, strip, lane) : std::nullopt;
    drag(desk, strip, under);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_ruler(desk, list, strip);
    draw_curves(desk, list, strip, lane + desk.px(14));
    draw_keys(desk, list, strip, lane, under);
    legend(desk);
}

void play_on(Desk& desk) {
    while (auto outcome = desk.flights.collect()) {
        desk.say(outcome->words, outcome->is_fault);
        if (outcome->opened) {
            desk.timeline.set_path(*std::move(outcome->opened));
        }
    }
    if (!desk.has_cube()) {
        return;
    }
    if (desk.movie.file[0] == '\0') {
        const std::string name = model::stem_for(*desk.status.cube) + "-flight.toml";
        name.copy(desk.movie.file.data(), desk.movie.file.size() - 1);
    }
    if (const auto seen = desk.timeline.advance(desk.now, desk.lattice())) {
        show(desk, *seen);
    }
}

}  // namespace shearwater::ui
