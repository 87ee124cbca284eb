#pragma once
// Boxes over the picture, by their edges: the cube, what it is cropped to, and what the picture lacks.

#include "client/view/desk.h"

namespace shearwater::ui {

// In an area that shows the picture of a camera.
void draw_box_edges(const Desk& desk, const EyeArea& area, const view::Camera& camera);
void draw_missing(const Desk& desk, const EyeArea& area, const view::Camera& camera);

}  // namespace shearwater::ui
