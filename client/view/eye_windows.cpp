#include "client/view/eye_windows.h"

#include <GLFW/glfw3.h>

#include <algorithm>

namespace shearwater::ui {

// Textures are shared with the desk's window; the frame that they are copied from is of this context.
class EyeWindows::One {
  public:
    static std::unique_ptr<One> open(Window& window, const char* title) {
        GLFWwindow* const made = window.open_beside(title, 640, 480);
        return made != nullptr ? std::unique_ptr<One>(new One(window, made)) : nullptr;
    }
    ~One() { window_.close_beside(beside_); }
    One(const One&) = delete;
    One& operator=(const One&) = delete;

    bool is_closing() const { return glfwWindowShouldClose(beside_) != GLFW_FALSE; }
    view::ImageSize size() const {
        view::ImageSize size;
        glfwGetFramebufferSize(beside_, &size.width, &size.height);
        return size;
    }

    void show(const Texture& picture) {
        const view::ImageSize now = size();
        if (picture.empty() || now.width < 1 || now.height < 1) {
            return;
        }
        glfwMakeContextCurrent(beside_);
        if (frame_ == 0) {
            glfwSwapInterval(0);  // the desk's window waits for its display, once for all
            glGenFramebuffers(1, &frame_);
        }
        glBindFramebuffer(GL_READ_FRAMEBUFFER, frame_);
        glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture.id(), 0);
        glClearColor(0, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        const EyeArea area = fitted({0, 0}, {static_cast<float>(now.width), static_cast<float>(now.height)},
                                    {picture.width(), picture.height()});
        const auto left = static_cast<int>(area.from.x), top = static_cast<int>(area.from.y);
        const int right = left + static_cast<int>(area.size.x);
        const int bottom = top + static_cast<int>(area.size.y);
        // A picture's rows begin at the top, a window's at the bottom.
        glBlitFramebuffer(0, 0, picture.width(), picture.height(), left, now.height - top, right,
                          now.height - bottom, GL_COLOR_BUFFER_BIT, GL_LINEAR);
        glfwSwapBuffers(beside_);
        window_.draw_here();
    }

  private:
    One(Window& window, GLFWwindow* beside) : window_(window), beside_(beside) {}

    Window& window_;
    GLFWwindow* const beside_;
    unsigned frame_ = 0;  // ends with its context
};

EyeWindows::EyeWindows(Window& window) : window_(window) {}
EyeWindows::~EyeWindows() = default;

bool EyeWindows::open() {
    eyes_ = {One::open(window_, "Shearwater, left eye"), One::open(window_, "Shearwater, right eye")};
    return eyes_[0] && eyes_[1];
}

void EyeWindows::attend(Desk& desk) {
    const bool wanted = desk.shown == image::StereoMode::two_windows;
    const bool opened = eyes_[0] != nullptr;
    if (!wanted) {
        eyes_ = {};
    } else if (!opened && !open()) {
        desk.show({});
        desk.say("The eyes' windows cannot be opened", true);
        eyes_ = {};
    } else if (std::ranges::any_of(eyes_, &One::is_closing)) {
        desk.show({});
        eyes_ = {};
    }
    desk.eye_window.reset();
    if (eyes_[0]) {
        const auto pixels = [](const view::ImageSize& size) {
            return std::int64_t{size.width} * size.height;
        };
        desk.eye_window = std::max(eyes_[0]->size(), eyes_[1]->size(),
                                   [&](const auto& a, const auto& b) { return pixels(a) < pixels(b); });
    }
}

void EyeWindows::show(const Desk& desk) {
    if (eyes_[0] && desk.shown == image::StereoMode::two_windows) {
        eyes_[0]->show(desk.picture);
        eyes_[1]->show(desk.right_picture);
    }
}

}  // namespace shearwater::ui
