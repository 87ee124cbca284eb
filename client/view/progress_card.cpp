#include "client/view/progress_card.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

using model::Connection;

struct Progress {
    std::string title, detail, note;
    double fraction;  // below 0: unknown
};

// What there is to wait for before the first picture, be it a first look's.
std::optional<Progress> progress_for(const Desk& desk) {
    const model::Status& status = desk.status;
    const model::Tree& tree = status.tree;
    if (status.connection == Connection::connecting && desk.picture.empty()) {
        return Progress{"Connecting", status.words, desk.waiting_note, -1};
    }
    if (status.connection == Connection::waiting && desk.picture.empty()) {
        return Progress{again_in(status), status.words, "", -1};
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
            "", tree.loaded()};
    }
    if (desk.picture.empty()) {
        const int vacant = tree.in_phase(wire::pb::PHASE_VACANT);
        return vacant > 0 ? Progress{"Waiting for the tree", fmt::format("{} places are vacant", vacant), "",
                                     tree.loaded()}
                          : Progress{"Waiting for the first picture", status.words, "", -1};
    }
    return std::nullopt;
}

void bar(const Desk& desk, double fraction) {
    const float width = ImGui::GetContentRegionAvail().x, height = desk.px(6), round = desk.px(3);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float to = at.y + height;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + width, to}, theme::line, round);
    if (fraction >= 0) {
        const float done = std::max(height, width * static_cast<float>(fraction));
        list.AddRectFilled(at, {at.x + done, to}, theme::accent, round);
    } else {  // unknown: a piece that goes to and fro
        const float place = static_cast<float>(0.5 - 0.5 * std::cos(ImGui::GetTime() * 2)) * width * 0.75F;
        list.AddRectFilled({at.x + place, at.y}, {at.x + place + width / 4, to}, theme::accent, round);
    }
    ImGui::Dummy({width, height});
}

void wrapped(const Desk& desk, const std::string& words) {
    if (!words.empty()) {
        ImGui::PushTextWrapPos(0);
        small_text(desk, theme::muted, words);
        ImGui::PopTextWrapPos();
    }
}

}  // namespace

std::string again_in(const model::Status& status) {
    return fmt::format("Connecting again in {:.0f} s", std::ceil(status.retry_in));
}

void progress_card(Desk& desk, ImVec2 from, ImVec2 size) {
    const auto progress = progress_for(desk);
    if (!progress) {
        return;
    }
    const float width = std::min(desk.px(400), size.x - desk.px(32));
    ImGui::SetNextWindowPos({std::round(from.x + size.x / 2), std::round(from.y + size.y / 2)}, 0,
                            {0.5F, 0.5F});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, desk.px(8));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {desk.px(18), desk.px(16)});
    ImGui::Begin("progress", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    ImGui::PushFont(desk.fonts.bold);
    ImGui::TextUnformatted(progress->title.c_str());
    ImGui::PopFont();
    wrapped(desk, progress->detail);
    wrapped(desk, progress->note);
    ImGui::Dummy({0, desk.px(2)});
    bar(desk, progress->fraction);
    if (desk.picture.empty()) {
        ImGui::Dummy({0, desk.px(2)});
        desk.cancel = ImGui::Button("Cancel", {desk.px(96), 0}) || (desk.escape && !desk.in_dialog);
        desk.controls.note("progress/Cancel");
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
}

}  // namespace shearwater::ui
