#pragma once
// The cube's three axes as they point in the view, in a corner of the picture.

#include <array>

#include "client/view/desk.h"

namespace shearwater::ui {

constexpr std::array<ImU32, 3> axis_colours{IM_COL32(232, 110, 104, 255), IM_COL32(120, 200, 130, 255),
                                            IM_COL32(106, 160, 250, 255)};

// The part of the picture (window coordinates) that they take: its lower left corner.
EyeArea axes_area(const Desk& desk, ImVec2 from, ImVec2 size);
// Named as the header does, and pointing to where its values grow; x, y and z where it says nothing.
void draw_axes(const Desk& desk, const EyeArea& area);

}  // namespace shearwater::ui
