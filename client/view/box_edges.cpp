#include "client/view/box_edges.h"

#include <array>

#include "client/model/crop.h"

namespace shearwater::ui {

namespace {

view::Vec3 corner_of(const volume::Box& box, int corner, const view::Lattice& lattice) {
    view::Vec3 voxel;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        voxel[axis] = static_cast<double>((corner >> axis & 1) != 0 ? box.hi[a] : box.lo[a]);
    }
    return lattice.world_from_voxel(voxel);
}

// A line of the world, as far as it is before the eye: what is behind it has no place in the picture.
void draw_line(ImDrawList& list, const EyeArea& area, const view::Camera& camera, const view::ImageSize& size,
               view::Vec3 from, view::Vec3 to, ImU32 colour, float width) {
    if (camera.projection == view::Projection::perspective) {
        const view::Vec3 forward = view::axes_of(camera).forward;
        const double near = 1e-3 * glm::length(camera.target - camera.eye);
        double at_from = glm::dot(from - camera.eye, forward) - near;
        double at_to = glm::dot(to - camera.eye, forward) - near;
        if (at_from < 0 && at_to < 0) {
            return;
        }
        if (at_from < 0) {
            std::swap(from, to);
            std::swap(at_from, at_to);
        }
        if (at_to < 0) {
            to = from + (at_from / (at_from - at_to)) * (to - from);
        }
    }
    list.AddLine(area.from_pixels(view::project(camera, size, from).at, size),
                 area.from_pixels(view::project(camera, size, to).at, size), colour, width);
}

void draw_box(const Desk& desk, ImDrawList& list, const EyeArea& area, const view::Camera& camera,
              const volume::Box& box, ImU32 colour, float width) {
    for (int corner = 0; corner < 8; ++corner) {
        for (int axis = 0; axis < 3; ++axis) {
            if ((corner >> axis & 1) == 0) {
                draw_line(list, area, camera, desk.wish.size, corner_of(box, corner, desk.lattice()),
                          corner_of(box, corner | 1 << axis, desk.lattice()), colour, width);
            }
        }
    }
}

}  // namespace

void draw_box_edges(const Desk& desk, const EyeArea& area, const view::Camera& camera) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(area.from, {area.from.x + area.size.x, area.from.y + area.size.y}, true);
    const volume::Box shown = model::shown_box(desk.wish.crop, desk.lattice());
    draw_box(desk, list, area, camera, volume::whole(desk.lattice().n), theme::muted, desk.px(1));
    if (desk.wish.crop) {
        draw_box(desk, list, area, camera, shown, theme::accent, desk.px(1.5F));
    }
    list.PopClipRect();
}

void draw_missing(const Desk& desk, const EyeArea& area, const view::Camera& camera) {
    if (!desk.status.frame) {
        return;
    }
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(area.from, {area.from.x + area.size.x, area.from.y + area.size.y}, true);
    for (const model::Missing& missing : desk.status.frame->missing) {
        draw_box(desk, list, area, camera, missing.box, theme::bad, desk.px(1.5F));
    }
    list.PopClipRect();
}

}  // namespace shearwater::ui
