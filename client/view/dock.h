#pragma once
// Tabs along the bottom, under the picture, for what wants width: the transfer function's editor. Another tab
// is one line in dock.cpp.

#include "client/view/desk.h"

namespace shearwater::ui {

// Nominal pixels: the least width, and the height. A window of less than that, or less than twice as high,
// has none.
constexpr float dock_width = 560, dock_height = 224;

void dock(Desk& desk, ImVec2 from, ImVec2 size);

}  // namespace shearwater::ui
