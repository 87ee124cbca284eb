#include "client/view/sections.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

void session_section(Desk& desk) {
    if (!section(desk, "SESSION", false)) {
        return;
    }
    const float gap = desk.px(4);
    const float half = (ImGui::GetContentRegionAvail().x - gap) / 2;
    ImGui::BeginDisabled(!desk.history.can_undo());
    desk.undo = ImGui::Button("Undo", {half, 0}) || desk.undo;
    desk.controls.note("session/Undo");
    ImGui::EndDisabled();
    ImGui::SameLine(0, gap);
    ImGui::BeginDisabled(!desk.history.can_redo());
    desk.redo = ImGui::Button("Redo", {half, 0}) || desk.redo;
    desk.controls.note("session/Redo");
    ImGui::EndDisabled();
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::InputTextWithHint("##file", "a file for the session", desk.file.data(), desk.file.size(),
                             ImGuiInputTextFlags_AutoSelectAll);
    desk.controls.note("session/file");
    ImGui::BeginDisabled(!desk.has_cube());
    const int pressed = button_row(desk, "session", {"Save", "Open", "Picture"});
    ImGui::EndDisabled();
    desk.files.save = desk.files.save || pressed == 0;
    desk.files.open = desk.files.open || pressed == 1;
    desk.files.picture = desk.files.picture || pressed == 2;
}

}  // namespace shearwater::ui
