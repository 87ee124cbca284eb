#include <fmt/core.h>

#include <array>

#include "client/model/crop.h"
#include "client/view/sections.h"
#include "client/view/widgets.h"
#include "common/wcs/text.h"

namespace shearwater::ui {

namespace {

constexpr std::array names{"x", "y", "z"};

// One end of the box along an axis.
void plane_slider(Desk& desk, model::BoxFace face, float width) {
    const volume::Box box = model::shown_box(desk.wish.crop, desk.lattice());
    const auto a = static_cast<std::size_t>(face.axis);
    std::int64_t plane = face.upper ? box.hi[a] : box.lo[a];
    const std::int64_t first = 0, last = desk.lattice().n[a] - 1;
    const std::string name = fmt::format("{}{}", names[a], face.upper ? 1 : 0);
    const std::string words = fmt::format("{} {} %lld", names[a], face.upper ? "to" : "from");
    ImGui::SetNextItemWidth(width);
    if (ImGui::SliderScalar(("##crop" + name).c_str(), ImGuiDataType_S64, &plane, &first, &last,
                            words.c_str(), ImGuiSliderFlags_AlwaysClamp)) {
        model::move_face(desk.wish.crop, desk.lattice(), face, plane);
        desk.dragging = ImGui::IsItemActive();
    }
    desk.controls.note("crop/" + name);
}

// What the header says of both ends.
void world_line(const Desk& desk, int along) {
    const wcs::Axes& world = *desk.status.cube->world;
    const auto a = static_cast<std::size_t>(along);
    if (!world[a].known()) {
        return;
    }
    const volume::Box box = model::shown_box(desk.wish.crop, desk.lattice());
    const auto at = [&](std::int64_t plane) {
        return wcs::plane_text(world, along, desk.lattice().n, static_cast<double>(plane));
    };
    small_text(desk, theme::muted, fmt::format("{} {} to {}", world[a].label, at(box.lo[a]), at(box.hi[a])));
}

std::string size_text(const volume::Box& box) {
    return fmt::format("{} \u00d7 {} \u00d7 {} voxels", box.planes(0), box.planes(1), box.planes(2));
}

}  // namespace

void crop_section(Desk& desk) {
    desk.cropping = section(desk, "CROP", false) && desk.has_cube();
    if (!desk.cropping) {
        return;
    }
    const float gap = desk.px(8);
    const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
    for (int axis = 0; axis < 3; ++axis) {
        plane_slider(desk, {axis, false}, width);
        ImGui::SameLine(0, gap);
        plane_slider(desk, {axis, true}, width);
        world_line(desk, axis);
    }
    ImGui::BeginDisabled(!desk.wish.crop);
    if (ImGui::Button("Show the whole cube", {-FLT_MIN, 0})) {
        desk.wish.crop.reset();
    }
    desk.controls.note("crop/reset");
    ImGui::EndDisabled();
    small_text(desk, theme::muted, size_text(model::shown_box(desk.wish.crop, desk.lattice())));
}

}  // namespace shearwater::ui
