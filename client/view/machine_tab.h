#pragma once
// The machine at work: where a frame's time goes (DVR Fig. 8), how fast pictures come, and the tree as a
// drawing.

#include "client/view/desk.h"

namespace shearwater::ui {

// The figures: on the line where the cursor is.
void machine_tools(Desk& desk);
// Time by stage to the left, the tree to the right, down to the window's end.
void machine_body(Desk& desk);

}  // namespace shearwater::ui
