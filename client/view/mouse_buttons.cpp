#include "client/view/mouse_buttons.h"

#include <algorithm>
#include <cmath>

namespace shearwater::ui {

// Whole, as Dear ImGui makes places.
void MouseButtons::move(float x, float y) {
    at_ = {std::floor(x), std::floor(y)};
}

void MouseButtons::add(int button, bool is_down) {
    if (button >= 0 && button < ImGuiMouseButton_COUNT) {
        waiting_.push_back({button, is_down, at_});
    }
}

void MouseButtons::play(ImGuiIO& io) {
    if (!waiting_.empty()) {
        const Use use = waiting_.front();
        io.MousePos = use.at;
        if (io.MousePosPrev.x == use.at.x && io.MousePosPrev.y == use.at.y) {
            down_[static_cast<std::size_t>(use.button)] = use.is_down;
            waiting_.pop_front();
        }
    }
    std::ranges::copy(down_, io.MouseDown);
}

}  // namespace shearwater::ui
