#pragma once
// What of a pass only one eye sees, where a display shows two pictures in one place.

#include <imgui.h>

#include <array>

namespace shearwater::ui {

enum class Eye { left, right };

// Marks parts of the lists that Dear ImGui draws from; whoever draws them opens the gate of the eye it draws
// for. It has to stay where it is until they are drawn.
class EyeGates {
  public:
    EyeGates() = default;
    EyeGates(const EyeGates&) = delete;
    EyeGates& operator=(const EyeGates&) = delete;

    // What is added to the list from here on is seen by that eye alone, or again by both.
    void only(ImDrawList& list, Eye eye);
    static void both(ImDrawList& list);

    // Before all is drawn, in the context it is drawn in.
    void open(Eye eye);

  private:
    struct Gate {
        bool is_open = false;
    };
    static void pass(const ImDrawList* list, const ImDrawCmd* command);
    std::array<Gate, 2> gates_;
};

}  // namespace shearwater::ui
