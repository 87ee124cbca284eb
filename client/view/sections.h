#pragma once
// The parts of the panel, from the top: each draws itself where the cursor is, and changes the desk.

#include "client/view/desk.h"

namespace shearwater::ui {

// The name, the help, and how the link to the server stands.
void link_section(Desk& desk);
void cube_section(Desk& desk);
// Between which values it is shown, and how they are stretched.
void limits_section(Desk& desk);
void camera_section(Desk& desk);
// Undo and redo, and the view as a file.
void session_section(Desk& desk);
// Quality, culling, and how fast frames come.
void speed_section(Desk& desk);
// Which voxels are shown.
void crop_section(Desk& desk);
// A pair of pictures, for two eyes.
void stereo_section(Desk& desk);

}  // namespace shearwater::ui
