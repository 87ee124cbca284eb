#pragma once
// Transfer functions that are kept: a button that opens their list.

#include "client/view/desk.h"

namespace shearwater::ui {

void preset_menu(Desk& desk);
// What the shelf's thread has done since, into the wish and the message.
void take_presets(Desk& desk);

}  // namespace shearwater::ui
