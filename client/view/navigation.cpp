#include "client/view/navigation.h"

#include <GLFW/glfw3.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "client/view/widgets.h"
#include "common/wcs/text.h"

namespace shearwater::ui {

namespace {

// Where the mouse is in the picture of the eye that it is over, in its pixels.
struct Place {
    float to_pixels;  // per window coordinate
    view::Vec2 mouse;
};

Place place_of_mouse(const Desk& desk, const std::vector<EyeArea>& areas) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const auto under = std::ranges::find_if(areas, [&](const EyeArea& area) { return area.contains(mouse); });
    const EyeArea& area = under != areas.end() ? *under : areas.front();
    return {static_cast<float>(desk.wish.size.width) / area.size.x, area.to_pixels(mouse, desk.wish.size)};
}

void drag(Desk& desk, const Place& place) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.MouseDelta.x == 0 && io.MouseDelta.y == 0) {
        return;
    }
    const double dx = static_cast<double>(io.MouseDelta.x * place.to_pixels);
    const double dy = static_cast<double>(io.MouseDelta.y * place.to_pixels);
    const view::ImageSize& size = desk.wish.size;
    model::Viewpoint& viewpoint = desk.steer();
    if (io.MouseDown[ImGuiMouseButton_Right] || io.MouseDown[ImGuiMouseButton_Middle] || io.KeyShift) {
        model::pan(viewpoint, dx, dy, size, desk.lattice());
    } else if (io.KeyAlt) {
        model::drag_roll(viewpoint, place.mouse.x, place.mouse.y, dx, dy, size);
    } else if (desk.flying) {
        model::look_around(viewpoint, dx, dy, size, desk.lattice());
    } else {
        model::drag_orbit(viewpoint, dx, dy, size);
    }
}

void wheel(Desk& desk, const Place& place) {
    const auto notches = static_cast<double>(ImGui::GetIO().MouseWheel);
    if (notches == 0) {
        return;
    }
    if (desk.flying) {
        constexpr double per_notch = 1.25;
        desk.pace = std::clamp(desk.pace * std::pow(per_notch, notches), model::min_pace, model::max_pace);
        desk.say(fmt::format("Flying {:.2g} times as fast as at first", desk.pace));
        return;
    }
    constexpr double per_notch = 0.88;
    model::zoom(desk.steer(), std::pow(per_notch, notches), place.mouse.x, place.mouse.y, desk.wish.size,
                desk.lattice());
}

// Asked once for each place that the mouse rests at.
void read(Desk& desk, const Place& place) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool wanted = (desk.reading || io.KeyCtrl) && !desk.dragging && !ImGui::IsAnyMouseDown();
    const bool rests = io.MouseDelta.x == 0 && io.MouseDelta.y == 0;
    if (!wanted) {
        desk.read.reset();
        desk.read_at.reset();
    } else if (rests && desk.read_at != place.mouse) {
        desk.read_at = place.mouse;
        desk.pick = Desk::PickWish{model::Purpose::read, place.mouse};
    } else if (!rests) {
        desk.read.reset();
    }
}

void fly_or_land(Desk& desk) {
    desk.flying = !desk.flying && desk.has_cube();
    if (desk.flying) {
        model::begin_flight(desk.steer(), desk.lattice());
        desk.say("Flying: W A S D, Space and X; drag to look around; Escape lands");
    }
}

}  // namespace

void navigate_by_mouse(Desk& desk, const std::vector<EyeArea>& areas, ImVec2 from, ImVec2 size) {
    ImGui::SetCursorScreenPos(from);
    ImGui::InvisibleButton("picture", size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    desk.controls.note("picture");
    if (!desk.has_cube()) {
        return;
    }
    const Place place = place_of_mouse(desk, areas);
    // In the pass that presses the button the mouse may have come from afar.
    if (ImGui::IsItemActive() && !ImGui::IsItemActivated()) {
        drag(desk, place);
    }
    if (!ImGui::IsItemHovered()) {
        desk.read.reset();
        desk.read_at.reset();
        return;
    }
    wheel(desk, place);
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        desk.pick = Desk::PickWish{model::Purpose::pivot, place.mouse};
    } else {
        read(desk, place);
    }
}

bool navigate_by_key(Desk& desk, const KeyPress& press) {
    const view::ImageSize& size = desk.wish.size;
    const auto turn = [&](int right, int down) {
        const double step = size.height * 5.0 / 180;  // 5 degrees
        model::drag_orbit(desk.steer(), step * right, step * down, size);
    };
    const auto zoom = [&](double factor) {
        if (desk.has_cube()) {
            model::zoom(desk.steer(), factor, size.width / 2.0, size.height / 2.0, size, desk.lattice());
        }
    };
    if (press.control) {
        return false;
    }
    switch (press.key) {
        case GLFW_KEY_R:
            desk.jump_by(model::reset);
            break;
        case GLFW_KEY_0:
            if (desk.has_cube()) {
                desk.jump_by([&](model::Viewpoint& to) { model::fit(to, size, desk.lattice()); });
            }
            break;
        case GLFW_KEY_1:
        case GLFW_KEY_2:
        case GLFW_KEY_3:
        case GLFW_KEY_4:
        case GLFW_KEY_5:
        case GLFW_KEY_6:
            desk.jump_by([&](model::Viewpoint& to) {
                model::look_from(to, static_cast<model::Side>(press.key - GLFW_KEY_1));
            });
            break;
        case GLFW_KEY_P:
            desk.flying = false;
            desk.transition.stop();
            model::toggle_projection(desk.wish.viewpoint);
            break;
        case GLFW_KEY_F:
            fly_or_land(desk);
            break;
        case GLFW_KEY_V:
            desk.reading = !desk.reading;
            break;
        case GLFW_KEY_COMMA:
            model::roll(desk.steer(), -5);
            break;
        case GLFW_KEY_PERIOD:
            model::roll(desk.steer(), 5);
            break;
        case GLFW_KEY_LEFT:
            turn(1, 0);
            break;
        case GLFW_KEY_RIGHT:
            turn(-1, 0);
            break;
        case GLFW_KEY_UP:
            turn(0, 1);
            break;
        case GLFW_KEY_DOWN:
            turn(0, -1);
            break;
        case GLFW_KEY_EQUAL:
        case GLFW_KEY_KP_ADD:
            zoom(0.9);
            break;
        case GLFW_KEY_MINUS:
        case GLFW_KEY_KP_SUBTRACT:
            zoom(1 / 0.9);
            break;
        default:
            return false;
    }
    return true;
}

void navigate_on(Desk& desk, const Window& window) {
    if (const auto at = desk.transition.at(desk.now)) {
        desk.wish.viewpoint = *at;
        desk.dragging = true;
    }
    desk.flying = desk.flying && desk.has_cube() && !desk.escape;
    const ImGuiIO& io = ImGui::GetIO();
    if (!desk.flying || io.WantTextInput) {
        return;
    }
    const auto between = [&](int back, int ahead) {
        return (window.is_down(ahead) ? 1.0 : 0.0) - (window.is_down(back) ? 1.0 : 0.0);
    };
    const model::Thrust thrust{between(GLFW_KEY_A, GLFW_KEY_D), between(GLFW_KEY_X, GLFW_KEY_SPACE),
                               between(GLFW_KEY_S, GLFW_KEY_W)};
    if (thrust != model::Thrust(0)) {
        // A pass may have waited long for the first key.
        constexpr double longest = 0.1;
        const double seconds = std::min(static_cast<double>(io.DeltaTime), longest);
        model::fly(desk.steer(), thrust, desk.pace, seconds, desk.lattice());
    }
}

std::string place_text(const Desk& desk, const view::Vec3& voxel, const char* between) {
    std::string words = fmt::format("voxel {:.0f} {:.0f} {:.0f}", voxel.x, voxel.y, voxel.z);
    const std::string world =
        wcs::place_text(*desk.status.cube->world, desk.lattice().n, {voxel.x, voxel.y, voxel.z});
    return world.empty() ? words : words + between + world;
}

void draw_reading(const Desk& desk) {
    if (!desk.read || !desk.has_cube()) {
        return;
    }
    const model::Picked& picked = *desk.read;
    std::string words = "nothing to be seen here";
    if (picked.hit) {
        const view::Vec3& voxel = picked.hit->voxel;
        const std::string unit = desk.status.cube->unit.empty() ? "" : " " + desk.status.cube->unit;
        words = fmt::format("{}\n{}", place_text(desk, voxel, "\n"),
                            std::isfinite(picked.value) ? fmt::format("{:.6g}{}", picked.value, unit)
                                                        : std::string("no value"));
    }
    ImGui::SetTooltip("%s%s", words.c_str(), picked.incomplete ? "\n(parts of the cube are missing)" : "");
}

}  // namespace shearwater::ui
