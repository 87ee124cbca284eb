#pragma once
// The operating system's window with a graphics context and Dear ImGui in it.

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "client/view/eye_gates.h"
#include "client/view/full_screen.h"
#include "client/view/input_events.h"
#include "client/view/theme.h"
#include "common/base/result.h"
#include "common/image/image.h"

struct GLFWwindow;

namespace shearwater::ui {

struct WindowOptions {
    int width = 1280;
    int height = 800;
    float scale = 0;  // 0: the display's
};

// One at a time; everything from the thread that opened it, except wake(). F11 has it fill its display.
class Window {
  public:
    static base::Result<std::unique_ptr<Window>> open(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    bool is_closing() const;
    void close();
    // Waits for input, a wake() or the time to pass, then begins a pass of widgets.
    void begin(double wait_seconds);
    // The keys pressed since the last call, however short.
    std::vector<KeyPress> take_keys() { return events_.take_keys(); }
    // Whether a key is held down now that was pressed without a control key, and none is held with it.
    bool is_down(int key) const;
    // Files that were dropped on the window since the last call.
    std::vector<std::string> take_drops() { return std::exchange(drops_, {}); }
    // Whether the display shows two buffers by turns, one for each eye.
    bool has_quad_buffers() const { return has_quad_buffers_; }
    // What of a pass one eye alone sees; where there is one buffer it is the left one's.
    EyeGates& gates() { return gates_; }
    struct Drawing {
        std::uint64_t uploads = 0;  // to textures, as they are counted
        bool for_each_eye = false;  // to the hidden buffer of each
        bool anyway = false;        // though it may be what is seen already
    };
    // Draws the pass to the hidden buffer, to be seen after show(); false, and nothing is to be shown here or
    // in a window beside, where it would look like the last that was drawn or the mouse has to be caught up
    // with.
    bool draw(const Drawing& drawing);
    // Draws it as one eye sees it, to the buffer that is drawn to now.
    void draw_for(Eye eye);
    image::Image<image::Rgba8> read_pixels() const;
    void show();

    // A plain window that shares the textures of this one, and whose keys count as this one's; null where
    // there can be none. It has to be closed before this one. Once it is uncovered, or has another size, the
    // next pass is drawn whatever it looks like.
    GLFWwindow* open_beside(const char* title, int width, int height);
    void close_beside(GLFWwindow* beside);
    // From another window's context back to this one's.
    void draw_here();

    // Ends a wait in begin(); from any thread while a window is open.
    static void wake();

    float scale() const { return scale_; }
    const theme::Fonts& fonts() const { return fonts_; }

  private:
    Window(GLFWwindow* window, float scale, bool has_quad_buffers);
    static void on_key(GLFWwindow* window, int key, int scancode, int action, int mods);
    static void on_character(GLFWwindow* window, unsigned character);
    static void on_cursor(GLFWwindow* window, double x, double y);
    static void on_button(GLFWwindow* window, int button, int action, int mods);
    static void on_drop(GLFWwindow* window, int count, const char** paths);
    static void on_uncovered(GLFWwindow* window);

    GLFWwindow* window_;
    float scale_;
    const bool has_quad_buffers_;
    theme::Fonts fonts_;
    EyeGates gates_;
    FullScreen full_screen_;
    InputEvents events_;
    std::set<int> with_control_;  // keys that went down so, and are down
    std::vector<std::string> drops_;
    std::optional<std::uint64_t> drawn_;  // what is seen, if all of it still is
};

}  // namespace shearwater::ui
