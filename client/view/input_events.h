#pragma once
// What was done with the mouse's buttons and the keys, given to Dear ImGui in the order in which it was done
// and where. By itself it asks once a pass what is down and where the mouse is: of a long pass it takes a
// drag up, and lets it go, where the mouse went later, and misses a key with another that was held for less.

#include <imgui.h>

#include <array>
#include <deque>
#include <utility>
#include <variant>
#include <vector>

namespace shearwater::ui {

// A key that went down, or repeats.
struct KeyPress {
    int key;  // GLFW's number
    bool shift, control;
};

class InputEvents {
  public:
    // The mouse came to a place, in window coordinates.
    void move(float x, float y);
    // A button was used there.
    void button(int number, bool is_down);
    void key(const KeyPress& press);
    void release(int key);
    void type(unsigned character) { waiting_.push_back(Typed{character}); }

    // Whether more is to come than the next pass takes.
    bool are_behind() const { return !waiting_.empty(); }
    // What the next pass sees: a button used, with the mouse where that was, or a key, and what it types. The
    // mouse lets go in a pass after the one that it comes there in: what it holds has then followed it.
    void play(ImGuiIO& io);
    // The keys that have been played since the last call.
    std::vector<KeyPress> take_keys() { return std::exchange(played_, {}); }

  private:
    struct Button {
        int number;
        bool is_down;
        ImVec2 at;
    };
    struct Release {
        int key;
    };
    struct Typed {
        unsigned character;
    };
    // What a pass has had: nothing but modifiers; a key or what it typed, which more of that may follow; a
    // button, and nothing else.
    enum class Pass { empty, key, full };
    // False, and the event waits for the next pass.
    bool take(const Button& use, Pass& pass, ImGuiIO& io);
    bool take(const KeyPress& press, Pass& pass, ImGuiIO& io);
    static bool take(const Release& release, Pass& pass, ImGuiIO& io);
    static bool take(const Typed& typed, Pass& pass, ImGuiIO& io);
    static bool set_key(int key, bool is_down, Pass& pass, ImGuiIO& io);

    ImVec2 at_{0, 0};
    std::deque<std::variant<Button, KeyPress, Release, Typed>> waiting_;
    std::array<bool, ImGuiMouseButton_COUNT> down_{};
    std::vector<KeyPress> played_;
};

}  // namespace shearwater::ui
