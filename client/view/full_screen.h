#pragma once
// Windows that fill the display they are on, and go back to where they were.

#include <map>

struct GLFWwindow;

namespace shearwater::ui {

class FullScreen {
  public:
    // Of the displays it is the one with the window's middle; else the first.
    void toggle(GLFWwindow* window);
    void forget(GLFWwindow* window) { before_.erase(window); }

  private:
    struct Place {
        int x = 0, y = 0, width = 0, height = 0;
    };
    static Place place_of(GLFWwindow* window);
    std::map<GLFWwindow*, Place> before_;  // of those that fill one
};

}  // namespace shearwater::ui
