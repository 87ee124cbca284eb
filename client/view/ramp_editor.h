#pragma once
// The plot of opacity over value with the ramp's two ends as handles (DVR 4.3).

#include "client/view/desk.h"

namespace shearwater::ui {

// Changes desk.wish.tf. The plot's upward axis is the cube root of opacity: an opacity per voxel that looks
// right is often a few thousandths.
void ramp_editor(Desk& desk);

}  // namespace shearwater::ui
