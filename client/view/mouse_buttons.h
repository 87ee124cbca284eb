#pragma once
// A mouse's buttons, given to Dear ImGui in the order in which they were used and where. By itself it asks
// once a pass how the mouse stands, and in a long pass takes a drag up, and lets it go, where the mouse went
// later.

#include <imgui.h>

#include <array>
#include <deque>

namespace shearwater::ui {

class MouseButtons {
  public:
    // The mouse came to a place, in window coordinates.
    void move(float x, float y);
    // A button was used there; of those that Dear ImGui does not know nothing is kept.
    void add(int button, bool is_down);
    // Whether more is to come than the next pass takes.
    bool are_behind() const { return !waiting_.empty(); }
    // What the next pass sees: the mouse where a button was used next, first as it came there and then, in a
    // pass after, with the button; where nothing waits the mouse stays where io has it.
    void play(ImGuiIO& io);

  private:
    struct Use {
        int button;
        bool is_down;
        ImVec2 at;
    };
    ImVec2 at_{0, 0};
    std::deque<Use> waiting_;
    std::array<bool, ImGuiMouseButton_COUNT> down_{};
};

}  // namespace shearwater::ui
