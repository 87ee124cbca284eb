#pragma once
// The slim panel on the right: link, cube, camera, speed and the tree.

#include "client/view/desk.h"

namespace shearwater::ui {

constexpr float panel_width = 304;  // nominal pixels

void panel(Desk& desk, ImVec2 from, ImVec2 size);

}  // namespace shearwater::ui
