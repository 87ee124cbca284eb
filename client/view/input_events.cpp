#include "client/view/input_events.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

namespace shearwater::ui {

namespace {

bool is_modifier(int key) {
    return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
}

}  // namespace

// Whole, as Dear ImGui makes places.
void InputEvents::move(float x, float y) {
    at_ = {std::floor(x), std::floor(y)};
}

void InputEvents::button(int number, bool is_down) {
    if (number >= 0 && number < ImGuiMouseButton_COUNT) {
        waiting_.push_back(Button{number, is_down, at_});
    }
}

void InputEvents::key(const KeyPress& press) {
    if (press.key >= 0 && press.key <= GLFW_KEY_LAST) {
        waiting_.push_back(press);
    }
}

void InputEvents::release(int key) {
    if (key >= 0 && key <= GLFW_KEY_LAST) {
        waiting_.push_back(Release{key});
    }
}

void InputEvents::play(ImGuiIO& io) {
    Pass pass = Pass::empty;
    while (!waiting_.empty() &&
           std::visit([&](const auto& event) { return take(event, pass, io); }, waiting_.front())) {
        waiting_.pop_front();
    }
    std::ranges::copy(down_, io.MouseDown);
    const auto either = [&](int left, int right) { return io.KeysDown[left] || io.KeysDown[right]; };
    io.KeyCtrl = either(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
    io.KeyShift = either(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
    io.KeyAlt = either(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
    io.KeySuper = either(GLFW_KEY_LEFT_SUPER, GLFW_KEY_RIGHT_SUPER);
}

bool InputEvents::take(const Button& use, Pass& pass, ImGuiIO& io) {
    if (pass != Pass::empty) {
        return false;
    }
    io.MousePos = use.at;
    pass = Pass::full;
    const bool was_there = io.MousePosPrev.x == use.at.x && io.MousePosPrev.y == use.at.y;
    if (!use.is_down && !was_there) {
        return false;
    }
    down_[static_cast<std::size_t>(use.number)] = use.is_down;
    return true;
}

bool InputEvents::take(const KeyPress& press, Pass& pass, ImGuiIO& io) {
    if (!set_key(press.key, true, pass, io)) {
        return false;
    }
    played_.push_back(press);
    return true;
}

bool InputEvents::take(const Release& release, Pass& pass, ImGuiIO& io) {
    return set_key(release.key, false, pass, io);
}

bool InputEvents::take(const Typed& typed, Pass& pass, ImGuiIO& io) {
    if (pass == Pass::full) {
        return false;
    }
    io.AddInputCharacter(typed.character);
    pass = Pass::key;
    return true;
}

bool InputEvents::set_key(int key, bool is_down, Pass& pass, ImGuiIO& io) {
    if (pass != Pass::empty) {
        return false;
    }
    io.KeysDown[key] = is_down;
    pass = is_modifier(key) ? Pass::empty : Pass::key;
    return true;
}

}  // namespace shearwater::ui
