#pragma once
// The colours of a transfer function as a bar, and its pins: a double click adds one, a drag moves it.

#include "client/view/desk.h"

namespace shearwater::ui {

void colour_bar(Desk& desk, ImVec2 from, ImVec2 to);

}  // namespace shearwater::ui
