#include "client/view/crop_handles.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "client/model/crop.h"
#include "common/wcs/text.h"

namespace shearwater::ui {

namespace {

struct Handle {
    model::BoxFace face;
    view::Projected at;
};

// The nearest first: of two that overlap it is the one that the mouse is to meet.
std::array<Handle, 6> handles_of(const Desk& desk, const volume::Box& box, const view::Camera& camera) {
    std::array<Handle, 6> handles;
    for (int n = 0; n < 6; ++n) {
        const model::BoxFace face{n / 2, n % 2 != 0};
        handles[static_cast<std::size_t>(n)] = {
            face, view::project(camera, desk.wish.size, model::middle_of(box, desk.lattice(), face))};
    }
    std::ranges::sort(handles, {}, [](const Handle& handle) { return handle.at.depth; });
    return handles;
}

// The face goes as far as the mouse has gone since it was taken up.
void drag(Desk& desk, const volume::Box& box, const view::Camera& camera, const EyeArea& area,
          model::BoxFace face) {
    const auto a = static_cast<std::size_t>(face.axis);
    if (ImGui::IsItemActivated() || !desk.crop_drag) {
        desk.crop_drag = {face, static_cast<double>(face.upper ? box.hi[a] : box.lo[a])};
        return;
    }
    const ImVec2 moved = ImGui::GetIO().MouseDelta;
    const view::Vec2 by{static_cast<double>(moved.x / area.size.x) * desk.wish.size.width,
                        static_cast<double>(moved.y / area.size.y) * desk.wish.size.height};
    const double last = static_cast<double>(desk.lattice().n[a] - 1);
    double& plane = desk.crop_drag->plane;
    plane += model::planes_dragged(box, desk.lattice(), face, camera, desk.wish.size, by);
    plane = std::clamp(plane, 0.0, last);
    model::move_face(desk.wish.crop, desk.lattice(), face, std::llround(plane));
    desk.dragging = true;
}

}  // namespace

void crop_handles(Desk& desk, const EyeArea& area, const view::Camera& camera, int n) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const volume::Box box = model::shown_box(desk.wish.crop, desk.lattice());
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
        desk.crop_drag.reset();
    }
    for (const auto& [face, at] : handles_of(desk, box, camera)) {
        const ImVec2 middle = area.from_pixels(at.at, desk.wish.size);
        const bool taken_up = desk.crop_drag && desk.crop_drag->face == face;
        if (!taken_up && (!at.seen_by(camera) || !area.contains(middle))) {
            continue;
        }
        const float reach = desk.px(9);
        const std::string name = fmt::format("crop/{}{}", "xyz"[face.axis], face.upper ? "-upper" : "-lower");
        ImGui::SetCursorScreenPos({middle.x - reach, middle.y - reach});
        ImGui::InvisibleButton(fmt::format("{}{}", name, n).c_str(), {2 * reach, 2 * reach});
        if (n == 0) {
            desk.controls.note(name, middle);
        }
        const bool held = ImGui::IsItemActive();
        if (held) {
            drag(desk, box, camera, area, face);
        }
        const bool lit = held || ImGui::IsItemHovered();
        list.AddCircleFilled(middle, desk.px(lit ? 6.5F : 5), lit ? theme::accent : theme::text, 20);
        list.AddCircle(middle, desk.px(lit ? 6.5F : 5), theme::well, 20, desk.px(1.5F));
        if (lit) {
            ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
            const auto a = static_cast<std::size_t>(face.axis);
            const std::int64_t plane = face.upper ? box.hi[a] : box.lo[a];
            const std::string world = wcs::plane_text(*desk.status.cube->world, face.axis, desk.lattice().n,
                                                      static_cast<double>(plane));
            ImGui::SetTooltip("%c %s %lld%s%s", "xyz"[face.axis], face.upper ? "to" : "from",
                              static_cast<long long>(plane), world.empty() ? "" : "\n", world.c_str());
        }
    }
}

}  // namespace shearwater::ui
