#pragma once
// The tree's nodes, each with the phase it is in.

#include "client/view/desk.h"

namespace shearwater::ui {

// Takes the rest of the panel.
void tree_list(Desk& desk);

}  // namespace shearwater::ui
