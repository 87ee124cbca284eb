#include "client/view/sections.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

void camera_section(Desk& desk) {
    if (!section(desk, "CAMERA")) {
        return;
    }
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
    desk.controls.note("camera/fov");
    ImGui::EndDisabled();
    if (ImGui::Button("Reset view", {-FLT_MIN, 0})) {
        desk.reset_view();
    }
}

}  // namespace shearwater::ui
