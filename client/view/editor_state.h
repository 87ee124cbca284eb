#pragma once
// What the transfer function's editor keeps from one pass to the next and is no part of the function itself.

#include <imgui.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "client/model/pins.h"
#include "client/model/plot_axes.h"

namespace shearwater::ui {

// A part of a pin that is held by the mouse, and how far the mouse was from it.
struct Held {
    std::size_t pin;
    std::optional<std::size_t> handle;  // none: the pin as a whole
    double s;                           // of the mouse, when last seen
    double ds = 0, up = 0;              // from the mouse to the handle, in s and of the plot's height
};

struct EditorState {
    std::optional<std::size_t> pin = 0;  // selected
    std::optional<std::size_t> colour;   // selected
    std::optional<Held> held;
    std::optional<double> held_colour;    // from the mouse to the colour pin, in s
    double menu_s = 0, menu_opacity = 0;  // where the menu was opened

    view::Unit unit = view::Unit::value;
    model::OpacityAxis axis = model::OpacityAxis::cube_root;

    // A number that is being typed.
    ImGuiID typing = 0;
    std::array<char, 40> typed{};

    // Presets.
    std::vector<std::string> presets;
    std::string preset;  // selected
    std::array<char, 80> preset_name{};
    view::Unit anchor = view::Unit::value;
    std::string message;  // what became of the last thing asked for
    bool is_fault = false;
};

}  // namespace shearwater::ui
