#include "client/view/window.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <boost/container_hash/hash.hpp>

#include "client/view/likeness.h"

namespace shearwater::ui {

namespace {

base::Error failed() {
    const char* text = nullptr;
    glfwGetError(&text);
    return base::error(base::Code::unsupported, "open the window",
                       text != nullptr ? text : "no reason given");
}

float display_scale(GLFWwindow* window) {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window, &x, &y);
    // Where a window's pixels are larger than the display's, ImGui already draws in the larger ones.
    int points = 1, pixels = 1, ignored = 0;
    glfwGetWindowSize(window, &points, &ignored);
    glfwGetFramebufferSize(window, &pixels, &ignored);
    const float per_point = points > 0 ? static_cast<float>(pixels) / static_cast<float>(points) : 1.0F;
    return std::clamp(std::max(x, y) / per_point, 0.5F, 4.0F);
}

}  // namespace

base::Result<std::unique_ptr<Window>> Window::open(const WindowOptions& options) {
    if (glfwInit() == GLFW_FALSE) {
        return failed();
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 2);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    // A display that can show a buffer to each eye has to be asked for them before it is known what for.
    glfwWindowHint(GLFW_STEREO, GLFW_TRUE);
    GLFWwindow* window = glfwCreateWindow(options.width, options.height, "Shearwater", nullptr, nullptr);
    const bool has_quad_buffers = window != nullptr;
    glfwWindowHint(GLFW_STEREO, GLFW_FALSE);
    if (window == nullptr) {
        window = glfwCreateWindow(options.width, options.height, "Shearwater", nullptr, nullptr);
    }
    if (window == nullptr) {
        base::Error error = failed();
        glfwTerminate();
        return error;
    }
    glfwSetWindowSizeLimits(window, 480, 320, GLFW_DONT_CARE, GLFW_DONT_CARE);
    const float scale = options.scale > 0 ? options.scale : display_scale(window);
    return std::unique_ptr<Window>(new Window(window, scale, has_quad_buffers));
}

Window::Window(GLFWwindow* window, float scale, bool has_quad_buffers)
    : window_(window), scale_(scale), has_quad_buffers_(has_quad_buffers) {
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    ImGui::CreateContext();
    // Seconds, as desktops have it: slow graphics take passes as long.
    ImGui::GetIO().MouseDoubleClickTime = 0.5F;
    ImGui::GetIO().IniFilename = nullptr;
    fonts_ = theme::apply(scale_);
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, on_key);
    glfwSetCharCallback(window_, on_character);
    glfwSetMouseButtonCallback(window_, on_button);
    glfwSetCursorPosCallback(window_, on_cursor);
    glfwSetDropCallback(window_, on_drop);
    glfwSetWindowRefreshCallback(window_, on_uncovered);
    glfwSetWindowFocusCallback(window_, ImGui_ImplGlfw_WindowFocusCallback);
    glfwSetCursorEnterCallback(window_, ImGui_ImplGlfw_CursorEnterCallback);
    glfwSetScrollCallback(window_, ImGui_ImplGlfw_ScrollCallback);
    ImGui_ImplGlfw_InitForOpenGL(window_, false);
    ImGui_ImplOpenGL3_Init("#version 150");
}

Window::~Window() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
    glfwTerminate();
}

bool Window::is_closing() const {
    return glfwWindowShouldClose(window_) != GLFW_FALSE;
}
void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}
void Window::wake() {
    glfwPostEmptyEvent();
}

void Window::on_key(GLFWwindow* window, int key, int, int action, int mods) {
    auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
    if (key == GLFW_KEY_F11) {
        if (action == GLFW_PRESS) {
            self.full_screen_.toggle(window);
        }
    } else if (action != GLFW_RELEASE) {
        self.events_.key({key, (mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0});
    } else {
        self.events_.release(key);
    }
    if (action == GLFW_RELEASE) {
        self.with_control_.erase(key);
    } else if ((mods & GLFW_MOD_CONTROL) != 0) {
        self.with_control_.insert(key);
    }
}

void Window::on_character(GLFWwindow* window, unsigned character) {
    static_cast<Window*>(glfwGetWindowUserPointer(window))->events_.type(character);
}

// Asked for, a place would be the mouse's of now, wherever what is being told of happened.
void Window::on_cursor(GLFWwindow* window, double x, double y) {
    static_cast<Window*>(glfwGetWindowUserPointer(window))
        ->events_.move(static_cast<float>(x), static_cast<float>(y));
}

void Window::on_button(GLFWwindow* window, int button, int action, int) {
    static_cast<Window*>(glfwGetWindowUserPointer(window))->events_.button(button, action == GLFW_PRESS);
}

// More at once than a person means are passed over.
void Window::on_drop(GLFWwindow* window, int count, const char** paths) {
    constexpr int most = 16;
    std::vector<std::string>& drops = static_cast<Window*>(glfwGetWindowUserPointer(window))->drops_;
    for (int i = 0; i < std::min(count, most); ++i) {
        drops.emplace_back(paths[i]);
    }
}

// What the window had in a part that was covered may be lost.
void Window::on_uncovered(GLFWwindow* window) {
    static_cast<Window*>(glfwGetWindowUserPointer(window))->drawn_.reset();
}

bool Window::is_down(int key) const {
    const auto held = [this](int each) { return glfwGetKey(window_, each) == GLFW_PRESS; };
    return held(key) && !with_control_.contains(key) && !held(GLFW_KEY_LEFT_CONTROL) &&
           !held(GLFW_KEY_RIGHT_CONTROL);
}

// What happened after what is still to be played comes after it.
void Window::begin(double wait_seconds) {
    if (!events_.are_behind()) {
        glfwWaitEventsTimeout(wait_seconds);
    }
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    events_.play(ImGui::GetIO());
    ImGui::NewFrame();
}

GLFWwindow* Window::open_beside(const char* title, int width, int height) {
    glfwWindowHint(GLFW_FOCUS_ON_SHOW, GLFW_FALSE);
    GLFWwindow* const beside = glfwCreateWindow(width, height, title, nullptr, window_);
    glfwWindowHint(GLFW_FOCUS_ON_SHOW, GLFW_TRUE);
    if (beside != nullptr) {
        glfwSetWindowUserPointer(beside, this);
        glfwSetKeyCallback(beside, on_key);
        glfwSetWindowRefreshCallback(beside, on_uncovered);
        glfwSetFramebufferSizeCallback(beside, [](GLFWwindow* window, int, int) { on_uncovered(window); });
    }
    return beside;
}

void Window::close_beside(GLFWwindow* beside) {
    full_screen_.forget(beside);
    glfwDestroyWindow(beside);
    draw_here();
}

void Window::draw_here() {
    glfwMakeContextCurrent(window_);
}

bool Window::draw(const Drawing& drawing) {
    ImGui::Render();
    if (events_.are_behind() && !drawing.anyway) {
        return false;
    }
    std::size_t drawn = likeness(*ImGui::GetDrawData());
    boost::hash_combine(drawn, drawing.uploads);
    boost::hash_combine(drawn, drawing.for_each_eye);
    if (std::exchange(drawn_, drawn) == drawn && !drawing.anyway) {
        return false;
    }
    if (drawing.for_each_eye && has_quad_buffers_) {
        glDrawBuffer(GL_BACK_RIGHT);
        draw_for(Eye::right);
        glDrawBuffer(GL_BACK_LEFT);
    }
    draw_for(Eye::left);
    if (has_quad_buffers_) {
        glDrawBuffer(GL_BACK);
    }
    return true;
}

void Window::draw_for(Eye eye) {
    gates_.open(eye);
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    const ImVec4 clear = ImGui::ColorConvertU32ToFloat4(theme::backdrop);
    glViewport(0, 0, width, height);
    glClearColor(clear.x, clear.y, clear.z, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

// The card's rows begin at the bottom, ours at the top.
image::Image<image::Rgba8> Window::read_pixels() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    image::Image<image::Rgba8> pixels(std::max(width, 1), std::max(height, 1));
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.pixels().data());
    for (int y = 0; y < pixels.height() / 2; ++y) {
        std::ranges::swap_ranges(pixels.row(y), pixels.row(pixels.height() - 1 - y));
    }
    for (image::Rgba8& pixel : pixels.pixels()) {
        pixel.a = 255;
    }
    return pixels;
}

void Window::show() {
    glfwSwapBuffers(window_);
}

}  // namespace shearwater::ui
