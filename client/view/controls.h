#pragma once
// Where the window's controls are, for scripts that use them by mouse: a file with a line for each.

#include <imgui.h>

#include <map>
#include <string>

#include "common/base/result.h"

namespace shearwater::ui {

class Controls {
  public:
    void begin_pass() { seen_.clear(); }
    // The widget just drawn, where any of it is to be seen. Names are unique: "camera/fov".
    void note(const std::string& name);
    // A handle that is no widget: its middle, in window coordinates.
    void note(const std::string& name, ImVec2 middle);

    // "NAME X Y WIDTH HEIGHT", window coordinates, a line for each; written anew, and at once as a whole,
    // when they are not what was last written.
    base::Status write(const std::string& path);

  private:
    struct Place {
        int x, y, width, height;
        bool operator==(const Place&) const = default;
    };
    std::map<std::string, Place> seen_, written_;
};

}  // namespace shearwater::ui
