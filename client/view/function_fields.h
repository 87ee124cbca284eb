#pragma once
// The transfer function's numbers: those of what is selected, the density, the colour map.

#include "client/view/desk.h"

namespace shearwater::ui {

void function_fields(Desk& desk);

}  // namespace shearwater::ui
