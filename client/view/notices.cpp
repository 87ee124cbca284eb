#include "client/view/notices.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

using model::Connection;

struct Notice {
    ImU32 colour;
    std::string title;
    std::string detail;
};

std::string missing_text(const std::vector<model::Missing>& missing) {
    constexpr std::size_t named = 2;
    std::string words;
    for (std::size_t i = 0; i < std::min(named, missing.size()); ++i) {
        words += (i > 0 ? ", " : "") +
                 fmt::format("place {} {}", missing[i].place, volume::to_string(missing[i].box));
    }
    return missing.size() > named ? words + fmt::format(" and {} more", missing.size() - named) : words;
}

// The one thing that matters most, or nothing to say.
std::optional<Notice> banner_for(const Desk& desk) {
    const model::Status& status = desk.status;
    switch (status.connection) {
        case Connection::refused:
            return Notice{theme::bad, "Refused", status.words};
        case Connection::waiting:
            return Notice{theme::busy,
                          fmt::format("Connecting again in {:.0f} s", std::ceil(status.retry_in)),
                          status.words};
        case Connection::connecting:
            return desk.picture.empty() ? std::nullopt
                                        : std::optional(Notice{theme::busy, "Connecting", status.words});
        case Connection::connected:
            break;
    }
    if (status.frame && !status.frame->missing.empty()) {
        const std::size_t parts = status.frame->missing.size();
        return Notice{theme::bad,
                      fmt::format("Incomplete: {} {} missing", parts, parts == 1 ? "part is" : "parts are"),
                      missing_text(status.frame->missing)};
    }
    return std::nullopt;
}

void banner(const Desk& desk, const Notice& notice, ImVec2 from, ImVec2 size) {
    ImFont* title_font = desk.fonts.text;
    ImFont* detail_font = desk.fonts.small;
    const float pad = desk.px(12), gap = desk.px(10), mark = desk.px(3);
    const float room = size.x - desk.px(48) - 2 * pad;
    const ImVec2 title = title_font->CalcTextSizeA(title_font->FontSize, FLT_MAX, 0, notice.title.c_str());
    const ImVec2 detail =
        detail_font->CalcTextSizeA(detail_font->FontSize, FLT_MAX, 0, notice.detail.c_str());
    const float width = std::min(room, title.x + gap + detail.x) + 2 * pad;
    const ImVec2 at{std::round(from.x + (size.x - width) / 2), from.y + desk.px(16)};
    const ImVec2 to{at.x + width, at.y + title.y + desk.px(14)};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, to, IM_COL32(26, 28, 34, 235), desk.px(6));
    list.AddRectFilled({at.x, at.y + desk.px(6)}, {at.x + mark, to.y - desk.px(6)}, notice.colour);
    list.PushClipRect(at, {to.x - pad, to.y}, true);
    const float y = at.y + desk.px(7);
    list.AddText(title_font, title_font->FontSize, {at.x + pad, y}, notice.colour, notice.title.c_str());
    list.AddText(detail_font, detail_font->FontSize,
                 {at.x + pad + title.x + gap, y + title_font->Ascent - detail_font->Ascent}, theme::text,
                 notice.detail.c_str());
    list.PopClipRect();
}

struct Progress {
    std::string title, detail;
    double fraction;  // below 0: unknown
};

// What there is to wait for before the first picture, be it a first look's.
std::optional<Progress> progress_for(const Desk& desk) {
    const model::Status& status = desk.status;
    const model::Tree& tree = status.tree;
    if (status.connection == Connection::connecting && desk.picture.empty()) {
        return Progress{"Connecting", status.words, -1};
    }
    if (status.connection != Connection::connected) {
        return std::nullopt;
    }
    if (status.first_look().empty() && !tree.nodes.empty() && !tree.ready &&
        tree.in_phase(wire::pb::PHASE_VACANT) == 0) {
        const std::string name = desk.has_cube() ? desk.status.cube->name : "the cube";
        return Progress{
            "Loading " + name,
            fmt::format("{} of {} nodes are ready", tree.in_phase(wire::pb::PHASE_READY), tree.nodes.size()),
            tree.loaded()};
    }
    if (desk.picture.empty()) {
        const int vacant = tree.in_phase(wire::pb::PHASE_VACANT);
        return vacant > 0 ? Progress{"Waiting for the tree", fmt::format("{} places are vacant", vacant),
                                     tree.loaded()}
                          : Progress{"Waiting for the first picture", status.words, -1};
    }
    return std::nullopt;
}

void progress_card(const Desk& desk, const Progress& progress, ImVec2 from, ImVec2 size) {
    const ImVec2 card{std::min(desk.px(360), size.x - desk.px(32)), desk.px(96)};
    const ImVec2 at{std::round(from.x + (size.x - card.x) / 2), std::round(from.y + (size.y - card.y) / 2)};
    const float pad = desk.px(18), right = at.x + card.x - pad;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + card.x, at.y + card.y}, IM_COL32(26, 28, 34, 235), desk.px(8));
    list.PushClipRect(at, {right, at.y + card.y}, true);
    list.AddText(desk.fonts.bold, desk.fonts.bold->FontSize, {at.x + pad, at.y + desk.px(16)}, theme::text,
                 progress.title.c_str());
    list.AddText(desk.fonts.small, desk.fonts.small->FontSize, {at.x + pad, at.y + desk.px(40)}, theme::muted,
                 progress.detail.c_str());
    list.PopClipRect();
    const ImVec2 bar{at.x + pad, at.y + desk.px(70)};
    const ImVec2 bar_end{right, bar.y + desk.px(6)};
    list.AddRectFilled(bar, bar_end, theme::line, desk.px(3));
    const float width = right - bar.x;
    if (progress.fraction >= 0) {
        const float done = std::max(desk.px(6), width * static_cast<float>(progress.fraction));
        list.AddRectFilled(bar, {bar.x + done, bar_end.y}, theme::accent, desk.px(3));
    } else {  // unknown: a piece that goes to and fro
        const float place = static_cast<float>(0.5 - 0.5 * std::cos(ImGui::GetTime() * 2)) * width * 0.75F;
        list.AddRectFilled({bar.x + place, bar.y}, {bar.x + place + width / 4, bar_end.y}, theme::accent,
                           desk.px(3));
    }
}

}  // namespace

void notices(const Desk& desk, ImVec2 from, ImVec2 size) {
    if (const auto progress = progress_for(desk)) {
        progress_card(desk, *progress, from, size);
    }
    if (const auto notice = banner_for(desk)) {
        banner(desk, *notice, from, size);
    }
}

void offers(Desk& desk, ImVec2 from, ImVec2 size) {
    if (!desk.offers_restoring) {
        return;
    }
    ImGui::SetNextWindowPos({from.x + size.x / 2, from.y + desk.px(56)}, 0, {0.5F, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, desk.px(6));
    ImGui::Begin("offer", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoNav);
    ImGui::AlignTextToFramePadding();
    text(theme::text, "A window on this cube did not end well.");
    ImGui::SameLine();
    desk.files.restore = ImGui::Button("Restore its view");
    desk.controls.note("offer/restore");
    ImGui::SameLine();
    desk.files.dismiss = ImGui::Button("No");
    desk.controls.note("offer/dismiss");
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace shearwater::ui
