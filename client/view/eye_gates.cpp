#include "client/view/eye_gates.h"

#include <GLFW/glfw3.h>

namespace shearwater::ui {

namespace {

// Nothing is drawn where no colour may be written.
void let_through(bool is_open) {
    const GLboolean on = is_open ? GL_TRUE : GL_FALSE;
    glColorMask(on, on, on, on);
}

}  // namespace

void EyeGates::pass(const ImDrawList*, const ImDrawCmd* command) {
    const auto* const gate = static_cast<const Gate*>(command->UserCallbackData);
    let_through(gate == nullptr || gate->is_open);
}

void EyeGates::only(ImDrawList& list, Eye eye) {
    list.AddCallback(pass, &gates_[static_cast<std::size_t>(eye)]);
}

void EyeGates::both(ImDrawList& list) {
    list.AddCallback(pass, nullptr);
}

void EyeGates::open(Eye eye) {
    for (std::size_t n = 0; n < gates_.size(); ++n) {
        gates_[n].is_open = n == static_cast<std::size_t>(eye);
    }
    let_through(true);
}

}  // namespace shearwater::ui
