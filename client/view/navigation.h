#pragma once
// What mouse and keys do to the viewpoint, and what they ask of the picture.

#include "client/view/desk.h"
#include "client/view/window.h"

namespace shearwater::ui {

// The mouse over the rectangle (window coordinates) with the eyes' pictures in it.
void navigate_by_mouse(Desk& desk, const std::vector<EyeArea>& areas, ImVec2 from, ImVec2 size);
// A key that went down; false if it is none of these.
bool navigate_by_key(Desk& desk, const KeyPress& press);
// The time that passed since the last pass: keys that are held while flying, and jumps under way.
void navigate_on(Desk& desk, const Window& window);
// Of a voxel in the cube: its indices, and what the header says of it, if anything.
std::string place_text(const Desk& desk, const view::Vec3& voxel, const char* between);
// Beside the mouse, what is known of the voxel under it.
void draw_reading(const Desk& desk);

}  // namespace shearwater::ui
