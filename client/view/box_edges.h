#pragma once
// The edges of the cube, and of the box that it is cropped to, over the picture.

#include "client/view/desk.h"

namespace shearwater::ui {

// In an area that shows the picture of a camera.
void draw_box_edges(const Desk& desk, const EyeArea& area, const view::Camera& camera);

}  // namespace shearwater::ui
