#include "client/view/sections.h"
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
        case Connection::none:
            return theme::vacant;
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
        case Connection::none:
            return "not connected";
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
    {"Alt left drag; comma, period", "roll"},
    {"Wheel", "zoom at the cursor"},
    {"Double click", "turn about what is there"},
    {"V, or hold Ctrl", "voxel and value at the cursor"},
    {"R; 0", "reset the view; fit the cube in"},
    {"1 to 6", "look from +x, -x, +y, -y, +z, -z"},
    {"P", "perspective or parallel"},
    {"F", "fly, and land again (or Escape)"},
    {"  W A S D, Space, X", "ahead, aside, back, up, down"},
    {"  Left drag, wheel", "look around, how fast"},
    {"C, Shift C", "next, previous colour map"},
    {"I", "reverse the colour map"},
    {"Arrows, +, -", "turn, zoom"},
    {"Ctrl Z, Ctrl Y", "undo, redo"},
    {"Ctrl S, Ctrl O", "save, open the session"},
    {"Ctrl N", "connect to another cube"},
    {"Ctrl P", "save the picture, with its session"},
    {"B", "the cube's edges, with coordinates"},
    {"E", "hide or show the editor"},
    {"Ctrl drag on the plot", "snap to edges and round values"},
    {"Delete", "delete the selected pin"},
    {"Tab", "hide or show this panel"},
    {"F11", "fill the display, or no longer"},
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

}  // namespace

void link_section(Desk& desk) {
    ImGui::PushFont(desk.fonts.bold);
    ImGui::TextUnformatted("Shearwater");
    ImGui::PopFont();
    const float side = ImGui::GetFrameHeight(), wide = desk.px(112);
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - side - desk.px(6) - wide);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - desk.px(2));
    desk.connect_elsewhere = ImGui::Button("Connect to ...", {wide, side}) || desk.connect_elsewhere;
    desk.controls.note("link/Connect to");
    ImGui::SameLine(0, desk.px(6));
    ImGui::Button("?", {side, side});
    desk.controls.note("help");
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

}  // namespace shearwater::ui
