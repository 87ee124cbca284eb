// A real window under a virtual display, on a real tree, driven by synthetic mouse and keys.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <thread>

#include "common/image/png.h"
#include "tests/support/window_driver.h"

namespace shearwater {
namespace {

using namespace std::chrono_literals;
using test::Picture;

constexpr int width = 960, height = 640;
// Where the picture is, clear of the panel, the status line, the axes and the notices at the top.
constexpr int left = 96, right = 640, top = 64, bottom = 600;
constexpr int middle_x = (960 - 304) / 2, middle_y = (640 - 26) / 2;

std::string program(const std::string& name) {
    return std::string(SHEARWATER_BIN) + "/" + name;
}

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

int brightness(const image::Rgba8& p) {
    return p.r + p.g + p.b;
}

// What a test looks at: where the light of the picture is and how far it spreads.
struct Light {
    double sum = 0, x = 0, y = 0, spread = 0;
    double red = 0, blue = 0;  // shares
};

Light light_of(const Picture& screen) {
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
double difference(const Picture& a, const Picture& b) {
    int count = 0;
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            count += std::abs(brightness(a.at(x, y)) - brightness(b.at(x, y))) > 12 ? 1 : 0;
        }
    }
    return static_cast<double>(count) / ((bottom - top) * (right - left));
}

bool same_picture(const Picture& a, const Picture& b) {
    for (int y = top; y < bottom; ++y) {
        if (!std::ranges::equal(a.row(y).subspan(left, right - left), b.row(y).subspan(left, right - left))) {
            return false;
        }
    }
    return true;
}

// The middle of the left-most white disc in the panel's plot.
std::optional<std::pair<int, int>> ramp_handle(const Picture& screen) {
    for (int x = 676; x < 900; ++x) {
        for (int y = 310; y < 500; ++y) {
            bool is_disc = true;
            for (int dy = -1; dy <= 2; ++dy) {
                for (int dx = -1; dx <= 2; ++dx) {
                    is_disc = is_disc && brightness(screen.at(x + dx, y + dy)) > 600;
                }
            }
            if (is_disc) {
                return std::pair{x, y};
            }
        }
    }
    return std::nullopt;
}

// What the dot in the status line says of the picture.
enum class Mark { none, lesser, refining, best };

Mark mark_of(const Picture& screen) {
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
int free_port() {
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
        display_ = std::make_unique<test::Display>(width, height);
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
                                         "1"};
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

    std::string secret_ = "window-test-secret-0123456789";
    test::TemporaryFolder folder_;
    int port_ = free_port();
    std::unique_ptr<test::Display> display_;
    std::unique_ptr<test::Process> tree_, window_;
};

TEST_F(WindowTest, MouseAndKeysChangeThePicture) {
    start_tree();
    open_window();
    const Picture first = lit("the first picture");
    const Light at_first = light_of(first);

    display_->drag(1, middle_x, middle_y, 120, 60);
    other_than(first, "a turn by the mouse");
    display_->key("r");
    like(first, "the view reset by R");

    display_->drag(3, middle_x, middle_y, 80, -40);
    Light moved = light_of(other_than(first, "a pan by the right button"));
    EXPECT_NEAR(moved.x - at_first.x, 80, 12);
    EXPECT_NEAR(moved.y - at_first.y, -40, 12);
    display_->click(middle_x, middle_y, 2);
    like(first, "the view reset by a double click");

    display_->drag(1, middle_x, middle_y, -60, 0, "shift");
    moved = light_of(other_than(first, "a pan by shift and the left button"));
    EXPECT_NEAR(moved.x - at_first.x, -60, 12);
    display_->key("r");
    like(first, "the view reset");

    display_->wheel(middle_x, middle_y, 4);
    const Light larger = light_of(other_than(first, "a zoom by the wheel"));
    EXPECT_GT(larger.spread, at_first.spread * 1.2);
    display_->key("r");
    like(first, "the view reset");

    display_->key("p");
    const Picture parallel = other_than(first, "parallel projection");
    EXPECT_NEAR(light_of(parallel).spread, at_first.spread, at_first.spread * 0.2);
    display_->key("p");
    like(first, "perspective again");
}

// Of this cube every sample counts, so that a high picture takes a while on any machine.
TEST_F(WindowTest, QualityFollowsTheCamera) {
    start_tree("synthetic:random:128");
    open_window({"--target-rate", "60"});
    const auto is_best = [](const Picture& p) { return mark_of(p) == Mark::best; };
    const Picture first = settled(is_best, "the first picture, refined");
    EXPECT_GT(light_of(first).sum, 1e5);

    display_->press(1, middle_x, middle_y);
    const auto end = std::chrono::steady_clock::now() + 150s;
    Picture moving = display_->grab();
    for (int x = 1; mark_of(moving) != Mark::lesser || difference(moving, first) < 0.002; ++x) {
        ASSERT_LT(std::chrono::steady_clock::now(), end) << "no lesser picture came during a drag";
        display_->move(middle_x + x % 200, middle_y);
        moving = display_->grab();
    }
    display_->release(1);
    const Picture turned = settled(is_best, "the picture after a drag, refined");
    EXPECT_GT(difference(turned, first), 0.002);

    // By the panel: always drafts, and as it moves again.
    constexpr int draft_x = 656 + 117, auto_x = 656 + 48, quality_y = 589;
    display_->click(draft_x, quality_y);
    other_than(turned, "a draft of the view at rest");
    display_->click(auto_x, quality_y);
    like(turned, "the view at rest, refined again");
}

TEST_F(WindowTest, ColoursAndOpacityChangeThePicture) {
    start_tree();
    open_window();
    const Picture inferno = lit("the first picture");
    // The last in the menu, one step back over the first: blue at the low end.
    display_->key("shift+c");
    const Picture viridis = other_than(inferno, "the colour map before inferno");
    EXPECT_LT(light_of(viridis).red, light_of(inferno).red - 0.1);
    display_->key("c");
    like(inferno, "inferno again");
    display_->key("i");
    other_than(inferno, "inferno reversed");
    display_->key("i");
    like(inferno, "inferno again");

    // The ramp's lower end, the handle further to the left, is moved to the right.
    const auto handle = ramp_handle(inferno);
    ASSERT_TRUE(handle) << "the ramp has no handle";
    display_->drag(1, handle->first, handle->second, 90, 0);
    const Picture thinner = other_than(inferno, "the ramp's lower end moved");
    EXPECT_LT(light_of(thinner).sum, light_of(inferno).sum);
}

TEST_F(WindowTest, SurvivesTheServer) {
    open_window();
    std::this_thread::sleep_for(1s);
    start_tree();
    const Picture first = lit("a picture from a server that came after the window");
    display_->drag(1, middle_x, middle_y, 100, 30);
    const Picture turned = other_than(first, "a turn by the mouse");

    tree_->kill_group();
    tree_.reset();
    settled([&](const Picture& p) { return light_of(p).sum < light_of(turned).sum * 0.9; },
            "the last picture, dimmed");
    start_tree();
    like(turned, "the same view from the server started again");
}

TEST_F(WindowTest, ScreenshotIsTakenOnceThePictureIsWhole) {
    start_tree();
    const std::string file = (folder_ / "shot.png").string();
    test::Process shot(client({"--screenshot", file}), environment(), folder_ / "client.log");
    ASSERT_EQ(shot.wait(150s), 0) << text_of(folder_ / "client.log");
    const auto picture = image::read_png(file);
    ASSERT_TRUE(picture) << picture.error().message();
    EXPECT_EQ(picture->width(), width);
    EXPECT_EQ(picture->height(), height);
    EXPECT_GT(light_of(*picture).sum, 1e5);
}

TEST_F(WindowTest, AWrongSecretIsSaid) {
    start_tree();
    secret_ = "another-secret-0123456789";
    // The tree may need a moment to listen; until then the client tries again.
    test::Process shot(client({"--screenshot", (folder_ / "shot.png").string()}), environment(),
                       folder_ / "client.log");
    EXPECT_EQ(shot.wait(150s), 2);
    const std::string said = text_of(folder_ / "client.log");
    EXPECT_NE(said.find("secret"), std::string::npos) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
}

TEST_F(WindowTest, MistakesEndWithTwoAndOneLine) {
    const std::vector<std::vector<std::string>> mistakes = {
        {program("shearwater-client")},
        {program("shearwater-client"), "--connect", "nonsense host:1"},
        {program("shearwater-client"), "--connect", "localhost"},
        {program("shearwater-client"), "--connect", "localhost:1", "--size", "10x10"},
        {program("shearwater-client"), "--connect", "localhost:1", "--tf", "/nowhere/tf.toml"},
        {program("shearwater-client"), "--connect", "localhost:1", "--secret-file", "/nowhere/secret"},
    };
    for (std::size_t i = 0; i < mistakes.size(); ++i) {
        const auto log = folder_ / ("mistake-" + std::to_string(i));
        test::Process process(mistakes[i], environment(), log);
        EXPECT_EQ(process.wait(60s), 2) << i;
        const std::string said = text_of(log);
        EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    }
}

}  // namespace
}  // namespace shearwater
