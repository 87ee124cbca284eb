#pragma once
// Two windows with nothing but a picture in them, one for each eye, for a projector each.

#include <array>
#include <memory>

#include "client/view/desk.h"
#include "client/view/window.h"

namespace shearwater::ui {

// They are there while pairs are shown so. Keys pressed in them count as the desk's window's.
class EyeWindows {
  public:
    explicit EyeWindows(Window& window);
    ~EyeWindows();
    EyeWindows(const EyeWindows&) = delete;
    EyeWindows& operator=(const EyeWindows&) = delete;

    // Before a pass of widgets: opens them, closes them, and tells the desk how large the larger is. Where
    // one has been closed, or cannot be opened, pairs are shown no more.
    void attend(Desk& desk);
    // Shows the desk's pictures in them, after a pass.
    void show(const Desk& desk);

  private:
    class One;
    bool open();

    Window& window_;
    std::array<std::unique_ptr<One>, 2> eyes_;  // left, right; or none
};

}  // namespace shearwater::ui
