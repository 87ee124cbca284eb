#include "client/view/notices.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "client/view/progress_card.h"
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
            return desk.picture.empty() ? std::nullopt
                                        : std::optional(Notice{theme::busy, again_in(status), status.words});
        case Connection::connecting:
            return desk.picture.empty() ? std::nullopt
                                        : std::optional(Notice{theme::busy, "Connecting", status.words});
        case Connection::connected:
        case Connection::none:
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

}  // namespace

void notices(const Desk& desk, ImVec2 from, ImVec2 size) {
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
