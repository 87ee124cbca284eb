#pragma once
// What there is to wait for before a picture is seen, and how to wait no longer.

#include "client/view/desk.h"

namespace shearwater::ui {

// In the middle of that area, while there is something.
void progress_card(Desk& desk, ImVec2 from, ImVec2 size);

// "Connecting again in 3 s".
std::string again_in(const model::Status& status);

}  // namespace shearwater::ui
