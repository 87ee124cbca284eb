#pragma once
// Ticks and what the header says along the edges of the box, over the picture.

#include "client/view/desk.h"

namespace shearwater::ui {

// In an area that shows the picture of a camera, clear of `taken` (window coordinates). With `noted`, labels
// are among the controls: "scale/RA/20h34m".
void draw_edge_scales(Desk& desk, const EyeArea& area, const view::Camera& camera, const EyeArea& taken,
                      bool noted);

}  // namespace shearwater::ui
