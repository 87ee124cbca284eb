#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "client/model/crop.h"
#include "client/view/sections.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

// Of no mode, and then in the order of the modes.
constexpr std::array labels{
    "Off",      "Side by side", "One below the other",   "Red and cyan glasses", "Rows by turns",
    "Left eye", "Right eye",    "A buffer for each eye", "A window for each eye"};

// Why a mode cannot be had, or empty.
const char* missing_for(const Desk& desk, std::size_t n) {
    const bool is_quad = n > 0 && static_cast<image::StereoMode>(n - 1) == image::StereoMode::quad_buffered;
    return is_quad && !desk.has_quad_buffers ? "this display has no buffer for each eye" : "";
}

void mode_choice(Desk& desk) {
    const std::size_t now = desk.shown ? static_cast<std::size_t>(*desk.shown) + 1 : 0;
    ImGui::SetNextItemWidth(-FLT_MIN);
    const bool open = ImGui::BeginCombo("##stereo", labels[now]);
    desk.controls.note("stereo/mode");
    if (!open) {
        return;
    }
    if (desk.escape) {
        ImGui::CloseCurrentPopup();
    }
    for (std::size_t n = 0; n < labels.size(); ++n) {
        const std::string missing = missing_for(desk, n);
        const auto flags = missing.empty() ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
        if (ImGui::Selectable(labels[n], n == now, flags)) {
            desk.show(n == 0 ? Shown() : static_cast<image::StereoMode>(n - 1));
        }
        const std::string name(n == 0 ? "off" : image::stereo_mode_names[n - 1]);
        desk.controls.note("stereo/mode/" + name);
        if (!missing.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
            ImGui::SetTooltip("%s", missing.c_str());
        }
    }
    ImGui::EndCombo();
}

// A length in world units, between two, that the person may set. Whether they did.
bool length_slider(Desk& desk, const char* id, const char* words, double lo, double hi, double& length) {
    float value = static_cast<float>(length);
    ImGui::SetNextItemWidth(-FLT_MIN);
    const bool changed = ImGui::SliderFloat(id, &value, static_cast<float>(lo), static_cast<float>(hi), words,
                                            ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    if (changed) {
        length = static_cast<double>(value);
        desk.dragging = ImGui::IsItemActive();
    }
    return changed;
}

// How far apart the eyes see what is nearest and what is farthest.
std::string parallax_text(const Desk& desk, const view::Camera& camera) {
    const volume::Box box = model::shown_box(desk.wish.crop, desk.lattice());
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (int corner = 0; corner < 8; ++corner) {
        view::Vec3 voxel;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            voxel[axis] = static_cast<double>((corner >> axis & 1) != 0 ? box.hi[a] : box.lo[a]);
        }
        const view::Projected at =
            view::project(camera, desk.wish.size, desk.lattice().world_from_voxel(voxel));
        if (!at.seen_by(camera)) {
            return "the cube reaches behind the eyes";
        }
        const double parallax = view::parallax(camera, desk.eyes, at.depth, desk.wish.size);
        least = std::min(least, parallax);
        most = std::max(most, parallax);
    }
    return fmt::format("parallax from {:.0f} to {:.0f} pixels", least, most);
}

}  // namespace

void stereo_section(Desk& desk) {
    if (!section(desk, "STEREO", false)) {
        return;
    }
    mode_choice(desk);
    ImGui::BeginDisabled(!desk.shown || !desk.has_cube());
    if (desk.has_cube()) {
        const view::Camera camera = view::camera(desk.wish.viewpoint, desk.lattice());
        view::StereoSettings all = view::resolved(desk.eyes, camera);
        const double distance = view::resolved({}, camera).convergence;
        if (length_slider(desk, "##separation", "eyes %.3g apart", 0.002 * distance, 0.2 * distance,
                          all.separation)) {
            desk.eyes.separation = all.separation;
        }
        desk.controls.note("stereo/separation");
        if (length_slider(desk, "##convergence", "converging at %.3g", 0.2 * distance, 5 * distance,
                          all.convergence)) {
            desk.eyes.convergence = all.convergence;
        }
        desk.controls.note("stereo/convergence");
        ImGui::Checkbox("swap the eyes", &desk.eyes.swap);
        desk.controls.note("stereo/swap");
        ImGui::SameLine();
        if (ImGui::Button("Defaults", {-FLT_MIN, 0})) {
            desk.eyes = {.separation = 0, .convergence = 0, .swap = desk.eyes.swap};
        }
        desk.controls.note("stereo/defaults");
        small_text(desk, theme::muted, parallax_text(desk, camera));
        if (desk.eye_window) {
            small_text(desk, theme::muted, "F11 has a window fill its display");
        }
    }
    ImGui::EndDisabled();
}

}  // namespace shearwater::ui
