#include "client/view/panel.h"

#include "client/view/sections.h"
#include "client/view/tree_list.h"

namespace shearwater::ui {

void panel(Desk& desk, ImVec2 from, ImVec2 size) {
    ImGui::SetNextWindowPos(from);
    ImGui::SetNextWindowSize(size);
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoBringToFrontOnFocus);
    link_section(desk);
    cube_section(desk);
    limits_section(desk);
    camera_section(desk);
    session_section(desk);
    speed_section(desk);
    crop_section(desk);
    stereo_section(desk);
    tree_list(desk);
    ImGui::End();
}

}  // namespace shearwater::ui
