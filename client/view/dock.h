#pragma once
// Tabs along the bottom, under the picture, for what wants width: the transfer function's editor. Another tab
// is one line in dock.cpp.

#include "client/view/desk.h"

namespace shearwater::ui {

constexpr float dock_height = 224;  // nominal pixels

void dock(Desk& desk, ImVec2 from, ImVec2 size);

}  // namespace shearwater::ui
