#pragma once
// The operating system's window with a graphics context and Dear ImGui in it.

#include <memory>
#include <string>
#include <utility>
#include <vector>

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

// A key that went down, or repeats.
struct KeyPress {
    int key;  // GLFW's number
    bool shift, control;
};

// One at a time; everything from the thread that opened it, except wake().
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
    // The keys pressed since the last call, however short. (Dear ImGui sees only what is down in a pass.)
    std::vector<KeyPress> take_keys() { return std::exchange(keys_, {}); }
    // Whether a key is held down now, and no control key with it.
    bool is_down(int key) const;
    // Files that were dropped on the window since the last call.
    std::vector<std::string> take_drops() { return std::exchange(drops_, {}); }
    // Draws the pass to the hidden buffer; the picture is seen after show().
    void draw();
    image::Image<image::Rgba8> read_pixels() const;
    void show();
    // Ends a wait in begin(); from any thread while a window is open.
    static void wake();

    float scale() const { return scale_; }
    const theme::Fonts& fonts() const { return fonts_; }

  private:
    Window(GLFWwindow* window, float scale);
    static void on_key(GLFWwindow* window, int key, int scancode, int action, int mods);
    static void on_drop(GLFWwindow* window, int count, const char** paths);

    GLFWwindow* window_;
    float scale_;
    theme::Fonts fonts_;
    std::vector<KeyPress> keys_;
    std::vector<std::string> drops_;
};

}  // namespace shearwater::ui
