#pragma once
// The cube's three axes as they point in the view, in a corner of the picture.

#include "client/view/desk.h"

namespace shearwater::ui {

void draw_axes(const Desk& desk, ImVec2 centre);
constexpr float axes_radius = 30;  // nominal pixels

}  // namespace shearwater::ui
