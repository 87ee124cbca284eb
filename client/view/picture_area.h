#pragma once
// The picture, what the mouse does on it, and what has to be said over it.

#include "client/view/desk.h"

namespace shearwater::ui {

// Fills the rectangle (window coordinates); the wish gets its size in the display's pixels.
void picture_area(Desk& desk, ImVec2 from, ImVec2 size);

// One line below the picture: what has just been done or refused, or what became of the link, and what is
// seen.
constexpr float status_height = 26;  // nominal pixels
void status_line(const Desk& desk, ImVec2 from, ImVec2 size);

}  // namespace shearwater::ui
