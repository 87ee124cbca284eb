#include "client/view/sections.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

using model::Number;
using model::Units;

void projection(Desk& desk) {
    model::Viewpoint& viewpoint = desk.wish.viewpoint;
    const bool parallel = viewpoint.projection == view::Projection::parallel;
    if (switch_among(desk, "camera", {"Perspective", "Parallel"}, parallel ? 1 : 0) != (parallel ? 1 : 0)) {
        desk.transition.stop();
        desk.flying = false;
        model::toggle_projection(viewpoint);
    }
    ImGui::BeginDisabled(!desk.has_cube());
    float fov = static_cast<float>(viewpoint.fov);
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (ImGui::SliderFloat("##fov", &fov, model::min_fov, model::max_fov, "field of view %.0f\u00b0",
                           ImGuiSliderFlags_AlwaysClamp)) {
        desk.transition.stop();
        model::set_fov(viewpoint, static_cast<double>(fov), desk.lattice());
        desk.dragging = ImGui::IsItemActive();
    }
    desk.controls.note("camera/fov");
    ImGui::EndDisabled();
}

void jumps(Desk& desk) {
    const int side = button_row(desk, "camera", {"+x", "-x", "+y", "-y", "+z", "-z"});
    if (side >= 0) {
        desk.jump_by([&](model::Viewpoint& to) { model::look_from(to, static_cast<model::Side>(side)); });
    }
    ImGui::BeginDisabled(!desk.has_cube());
    switch (button_row(desk, "camera", {"Fit", "Reset", desk.flying ? "Land" : "Fly"})) {
        case 0:
            desk.jump_by([&](model::Viewpoint& to) { model::fit(to, desk.wish.size, desk.lattice()); });
            break;
        case 1:
            desk.jump_by(model::reset);
            break;
        case 2:
            desk.flying = !desk.flying;
            if (desk.flying) {
                model::begin_flight(desk.steer(), desk.lattice());
            }
            break;
        default:
            break;
    }
    ImGui::EndDisabled();
}

struct Field {
    Number which;
    const char* label;
    const char* name;
};

// Side by side, each below its label. What is typed counts once Enter is pressed.
void fields(Desk& desk, std::initializer_list<Field> row) {
    const float count = static_cast<float>(row.size());
    const float gap = desk.px(4);
    const float width = (ImGui::GetContentRegionAvail().x - gap * (count - 1)) / count;
    const float left = ImGui::GetCursorPosX();
    float x = left;
    for (const Field& field : row) {
        if (x > left) {
            ImGui::SameLine(x);
        }
        small_text(desk, theme::muted, field.label);
        x += width + gap;
    }
    x = left;
    for (const Field& field : row) {
        if (x > left) {
            ImGui::SameLine(x);
        }
        x += width + gap;
        double value = model::number(desk.wish.viewpoint, field.which, desk.units, desk.lattice());
        ImGui::SetNextItemWidth(width);
        ImGui::PushID(field.name);
        const bool entered =
            ImGui::InputDouble("##number", &value, 0, 0, "%.6g", ImGuiInputTextFlags_EnterReturnsTrue);
        ImGui::PopID();
        desk.controls.note(std::string("camera/") + field.name);
        if (entered) {
            model::Viewpoint to = desk.heading();
            const auto set = model::set_number(to, field.which, value, desk.units, desk.lattice());
            if (set) {
                desk.jump(to);
            } else {
                desk.say(std::string(field.label) + ": " + set.error().detail, true);
            }
        }
    }
}

void numbers(Desk& desk) {
    ImGui::Checkbox("numbers", &desk.numbers);
    desk.controls.note("camera/numbers");
    ImGui::SameLine(0, desk.px(14));
    ImGui::Checkbox("edges and scales", &desk.boxed);
    desk.controls.note("camera/boxed");
    if (!desk.numbers || !desk.has_cube()) {
        return;
    }
    const bool parallel = desk.wish.viewpoint.projection == view::Projection::parallel;
    fields(desk, {{Number::azimuth, "azimuth\u00b0", "azimuth"},
                  {Number::elevation, "elevation\u00b0", "elevation"},
                  {Number::roll, "roll\u00b0", "roll"}});
    if (parallel) {
        fields(desk, {{Number::distance, "distance", "distance"}, {Number::height, "height", "height"}});
    } else {
        fields(desk, {{Number::distance, "distance", "distance"},
                      {Number::fov, "field of view\u00b0", "fov-number"}});
    }
    fields(desk, {{Number::target_x, "target x", "target-x"},
                  {Number::target_y, "y", "target-y"},
                  {Number::target_z, "z", "target-z"}});
    const int held = desk.units == Units::voxels ? 0 : 1;
    desk.units =
        switch_among(desk, "camera", {"Voxels", "World units"}, held) == 0 ? Units::voxels : Units::world;
}

}  // namespace

void camera_section(Desk& desk) {
    if (!section(desk, "CAMERA")) {
        return;
    }
    projection(desk);
    jumps(desk);
    numbers(desk);
}

}  // namespace shearwater::ui
