#include "client/view/full_screen.h"

#include <GLFW/glfw3.h>

namespace shearwater::ui {

FullScreen::Place FullScreen::place_of(GLFWwindow* window) {
    Place place;
    glfwGetWindowPos(window, &place.x, &place.y);
    glfwGetWindowSize(window, &place.width, &place.height);
    return place;
}

void FullScreen::toggle(GLFWwindow* window) {
    if (const auto found = before_.find(window); found != before_.end()) {
        const Place& to = found->second;
        glfwSetWindowMonitor(window, nullptr, to.x, to.y, to.width, to.height, GLFW_DONT_CARE);
        before_.erase(found);
        return;
    }
    const Place now = place_of(window);
    int count = 0;
    GLFWmonitor** const monitors = glfwGetMonitors(&count);
    GLFWmonitor* under = count > 0 ? monitors[0] : nullptr;
    for (int n = 0; n < count; ++n) {
        int x = 0, y = 0, width = 0, height = 0;
        glfwGetMonitorPos(monitors[n], &x, &y);
        if (const GLFWvidmode* const mode = glfwGetVideoMode(monitors[n]); mode != nullptr) {
            width = mode->width;
            height = mode->height;
        }
        const int dx = now.x + now.width / 2 - x, dy = now.y + now.height / 2 - y;
        if (dx >= 0 && dy >= 0 && dx < width && dy < height) {
            under = monitors[n];
        }
    }
    const GLFWvidmode* const mode = under != nullptr ? glfwGetVideoMode(under) : nullptr;
    if (mode != nullptr) {
        before_.emplace(window, now);
        glfwSetWindowMonitor(window, under, 0, 0, mode->width, mode->height, mode->refreshRate);
    }
}

}  // namespace shearwater::ui
