#pragma once
// A real window under a virtual display, on a real tree, driven by synthetic mouse and keys.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

#include "common/image/png.h"
#include "tests/support/window_driver.h"

namespace shearwater::window_test {

using namespace std::chrono_literals;
using test::Picture;

constexpr int panel_width = 304, dock_height = 224, status_height = 26;
constexpr int width = 960, height = 640 + dock_height;
// Where the picture is, clear of the panel, the status line, the axes and the notices at the top.
constexpr int left = 96, right = 640, top = 64, bottom = 600;
constexpr int middle_x = (width - panel_width) / 2, middle_y = (height - dock_height - status_height) / 2;

inline std::string program(const std::string& name) {
    return std::string(SHEARWATER_BIN) + "/" + name;
}

inline std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline int brightness(const image::Rgba8& p) {
    return p.r + p.g + p.b;
}

// What a test looks at: where the light of the picture is and how far it spreads.
struct Light {
    double sum = 0, x = 0, y = 0, spread = 0;
    double red = 0, blue = 0;  // shares
};

inline Light light_of(const Picture& screen) {
    Light light;
    double xx = 0, red = 0, blue = 0;
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            const image::Rgba8& p = screen.at(x, y);
            const double b = brightness(p) > 30 ? brightness(p) : 0;
            light.sum += b;
            light.x += b * x;
            light.y += b * y;
            xx += b * (x * x + y * y);
            red += b > 0 ? p.r : 0;
            blue += b > 0 ? p.b : 0;
        }
    }
    if (light.sum > 0) {
        light.x /= light.sum;
        light.y /= light.sum;
        light.spread = std::sqrt(std::max(0.0, xx / light.sum - light.x * light.x - light.y * light.y));
        light.red = red / light.sum;
        light.blue = blue / light.sum;
    }
    return light;
}

// The share of the picture's pixels that differ visibly.
inline double difference(const Picture& a, const Picture& b) {
    int count = 0;
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            count += std::abs(brightness(a.at(x, y)) - brightness(b.at(x, y))) > 12 ? 1 : 0;
        }
    }
    return static_cast<double>(count) / ((bottom - top) * (right - left));
}

inline bool same_picture(const Picture& a, const Picture& b) {
    for (int y = top; y < bottom; ++y) {
        if (!std::ranges::equal(a.row(y).subspan(left, right - left), b.row(y).subspan(left, right - left))) {
            return false;
        }
    }
    return true;
}

// What the dot in the status line says of the picture.
enum class Mark { none, lesser, refining, best };

inline Mark mark_of(const Picture& screen) {
    const std::pair<image::Rgba8, Mark> marks[] = {{{84, 90, 102, 255}, Mark::lesser},
                                                   {{240, 180, 80, 255}, Mark::refining},
                                                   {{88, 196, 128, 255}, Mark::best}};
    for (int y = height - 20; y < height - 6; ++y) {
        for (int x = 480; x < 656; ++x) {
            for (const auto& [colour, mark] : marks) {
                bool is_dot = true;  // letters have no such middles
                for (int i = 0; i < 9; ++i) {
                    is_dot = is_dot && screen.at(x - 1 + i % 3, y - 1 + i / 3) == colour;
                }
                if (is_dot) {
                    return mark;
                }
            }
        }
    }
    return Mark::none;
}

// A port that was free a moment ago.
inline int free_port() {
    const int s = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(s, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(getsockname(s, reinterpret_cast<sockaddr*>(&address), &size), 0);
    close(s);
    return ntohs(address.sin_port);
}

class WindowTest : public testing::Test {
  protected:
    void SetUp() override {
        if (const std::string why = test::Display::unavailable(); !why.empty()) {
            GTEST_SKIP() << why;
        }
        display_ = std::make_unique<test::Display>(screen_width_, height);
        const auto cube = (folder_ / "cube.fits").string();
        test::Process sample(
            {program("shearwater"), "sample", "hi-galaxy", "--size", "48", "40", "44", "-o", cube},
            environment(), folder_ / "sample.log");
        ASSERT_EQ(sample.wait(120s), 0) << text_of(folder_ / "sample.log");
    }

    std::map<std::string, std::string> environment() const {
        // Graphics drivers keep what they allocate: leaks are looked for in every other test.
        return {{"SHEARWATER_SECRET", secret_},
                {"DISPLAY", display_->name()},
                {"XDG_CONFIG_HOME", (folder_ / "config").string()},
                {"XDG_STATE_HOME", (folder_ / "state").string()},
                {"ASAN_OPTIONS", "detect_leaks=0"},
                {"LIBGL_ALWAYS_SOFTWARE", "1"}};
    }
    std::string server() const { return "127.0.0.1:" + std::to_string(port_); }
    void start_tree() { start_tree((folder_ / "cube.fits").string()); }
    void start_tree(const std::string& cube) {
        tree_ =
            std::make_unique<test::Process>(std::vector<std::string>{program("shearwater"), "serve", cube,
                                                                     "--listen", server(), "--threads", "1"},
                                            environment(), folder_ / "tree.log");
    }
    std::vector<std::string> client(std::vector<std::string> more = {}) const {
        std::vector<std::string> command{program("shearwater-client"),
                                         "--connect",
                                         server(),
                                         "--size",
                                         std::to_string(width) + "x" + std::to_string(height),
                                         "--scale",
                                         "1",
                                         "--controls",
                                         (folder_ / "controls").string()};
        command.insert(command.end(), more.begin(), more.end());
        return command;
    }
    void open_window(std::vector<std::string> more = {}) {
        window_ =
            std::make_unique<test::Process>(client(std::move(more)), environment(), folder_ / "client.log");
    }

    // Waits for a screen that `holds` and whose picture then stays for a while: the high one has come.
    Picture settled(const std::function<bool(const Picture&)>& holds, const char* what) {
        const auto end = std::chrono::steady_clock::now() + 150s;
        Picture last = display_->grab();
        int same = 0;
        while (same < 8) {
            std::this_thread::sleep_for(120ms);
            Picture now = display_->grab();
            same = holds(now) && same_picture(now, last) ? same + 1 : 0;
            last = std::move(now);
            if (!window_->running() || std::chrono::steady_clock::now() > end) {
                ADD_FAILURE() << what << ": " << (window_->running() ? "never seen" : "the window has ended")
                              << "\n"
                              << text_of(folder_ / "client.log") << text_of(folder_ / "tree.log");
                EXPECT_TRUE(image::write_png(
                    (std::filesystem::temp_directory_path() / "shearwater-window-failed.png").string(),
                    last));
                break;
            }
        }
        return last;
    }
    Picture lit(const char* what) {
        return settled([](const Picture& p) { return light_of(p).sum > 1e5; }, what);
    }
    Picture other_than(const Picture& before, const char* what) {
        return settled(
            [&](const Picture& p) { return difference(p, before) > 0.002 && light_of(p).sum > 1e4; }, what);
    }
    Picture like(const Picture& before, const char* what) {
        return settled([&](const Picture& p) { return difference(p, before) < 0.0005; }, what);
    }

    // The middle of a control, once there is one of that name; it is given time to come to rest.
    std::pair<int, int> control(const std::string& name) {
        const auto end = std::chrono::steady_clock::now() + 60s;
        do {
            std::this_thread::sleep_for(300ms);
            std::ifstream file(folder_ / "controls");
            for (std::string line; std::getline(file, line);) {
                // Names may have blanks in them, the four numbers behind have none.
                std::istringstream numbers(line.substr(std::min(line.size(), name.size() + 1)));
                int x = 0, y = 0, w = 0, h = 0;
                if (line.starts_with(name + " ") && numbers >> x >> y >> w >> h && numbers.peek() == EOF) {
                    return {x + w / 2, y + h / 2};
                }
            }
        } while (std::chrono::steady_clock::now() < end);
        ADD_FAILURE() << "there is no " << name << ":\n"
                      << text_of(folder_ / "client.log") << text_of(folder_ / "tree.log") << "among\n"
                      << text_of(folder_ / "controls");
        return {1, 1};
    }
    bool has_control(const std::string& name) const {
        return ("\n" + text_of(folder_ / "controls")).find("\n" + name + " ") != std::string::npos;
    }
    void click(const std::string& name, int times = 1) {
        const auto [x, y] = control(name);
        display_->click(x, y, times);
    }
    void drag(const std::string& name, int dx, int dy, const std::string& held_key = "") {
        const auto [x, y] = control(name);
        display_->drag(1, x, y, dx, dy, held_key);
    }
    static bool wait_for(const std::function<bool()>& holds) {
        const auto end = std::chrono::steady_clock::now() + 60s;
        while (!holds()) {
            if (std::chrono::steady_clock::now() > end) {
                return false;
            }
            std::this_thread::sleep_for(30ms);
        }
        return true;
    }
    // What closes with this, or is hidden.
    void gone(const std::string& name) {
        const auto end = std::chrono::steady_clock::now() + 60s;
        while (has_control(name)) {
            std::this_thread::sleep_for(50ms);
            ASSERT_LT(std::chrono::steady_clock::now(), end) << name << " stays";
        }
    }
    // What closes the menu that it is in.
    void pick(const std::string& name) {
        click(name);
        gone(name);
    }
    // In a combo.
    void choose(const std::string& name, const std::string& entry) {
        click(name);
        pick(name + "/" + entry);
    }
    // Into a field, instead of what it holds.
    void enter(const std::string& name, const std::string& text) {
        click(name);  // which selects all of it
        display_->type(text);
        display_->key("Return");
    }

    int screen_width_ = width;
    std::string secret_ = "window-test-secret-0123456789";
    test::TemporaryFolder folder_;
    int port_ = free_port();
    std::unique_ptr<test::Display> display_;
    std::unique_ptr<test::Process> tree_, window_;
};

}  // namespace shearwater::window_test
