#pragma once
// The editor of transfer functions (DVR 4.3, Fig. 6): pins over the cube's histogram, colours below, and
// numbers.

#include "client/view/desk.h"

namespace shearwater::ui {

// Pins to add, the units of both axes, presets: on the line where the cursor is.
void function_tools(Desk& desk);
// The plot and the colours to the left, numbers to the right, down to the window's end.
void function_body(Desk& desk);
// What is selected is deleted.
void delete_selected(Desk& desk);
// Before the widgets of a pass: what the presets' thread has done is taken over, and what was selected and is
// no longer there is let go.
void begin_editor_pass(Desk& desk);

}  // namespace shearwater::ui
