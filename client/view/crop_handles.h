#pragma once
// Handles on the faces of the box that the cube is cropped to, which the mouse drags over the picture.

#include "client/view/desk.h"

namespace shearwater::ui {

// In an area that shows the picture of a camera, the n-th of those on the screen. Before the picture's own
// widget, so that the mouse meets them first.
void crop_handles(Desk& desk, const EyeArea& area, const view::Camera& camera, int n);

}  // namespace shearwater::ui
