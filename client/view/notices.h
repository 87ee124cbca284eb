#pragma once
// What has to be said over the picture: the link is gone, parts are missing.

#include "client/view/desk.h"

namespace shearwater::ui {

void notices(const Desk& desk, ImVec2 from, ImVec2 size);
// What a person may answer, or not: the session that a window left behind.
void offers(Desk& desk, ImVec2 from, ImVec2 size);

}  // namespace shearwater::ui
