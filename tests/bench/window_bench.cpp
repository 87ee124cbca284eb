// How often a real window is drawn, in software under a virtual display: while a cube is turned by the mouse,
// while it rests under a moving mouse, and while its server stands still.
//
//   window_bench [SECONDS OF EACH]

#include <fmt/core.h>
#include <signal.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <span>
#include <thread>
#include <vector>

#include "common/view/anchored_function.h"
#include "deploy/bench/workload.h"
#include "deploy/local_tree.h"
#include "tests/support/window_driver.h"

namespace shearwater {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int width = 1280, height = 800;

struct Second {
    int passes = 0, drawn = 0, pictures = 0;
};

std::vector<Second> seconds_of(const std::filesystem::path& log) {
    std::ifstream lines(log);
    std::vector<Second> all;
    int n = 0;
    for (Second second; lines >> n >> second.passes >> second.drawn >> second.pictures;) {
        all.push_back(second);
    }
    return all;
}

// From those seconds on that begin now; the one that a phase begins or ends in is left out.
void print(const std::string& cube, const char* phase, std::span<const Second> seconds) {
    std::vector<int> passes, drawn, pictures;
    for (const Second& second : seconds) {
        passes.push_back(second.passes);
        drawn.push_back(second.drawn);
        pictures.push_back(second.pictures);
    }
    if (passes.empty()) {
        fmt::print("{:>4} {:>9} nothing was counted\n", cube, phase);
        return;
    }
    std::ranges::sort(passes);
    std::ranges::sort(drawn);
    std::ranges::sort(pictures);
    fmt::print("{:>4} {:>9} {:>9} {:>9} {:>9} {:>9} {:>11}\n", cube, phase, passes.size(), passes.front(),
               passes[passes.size() / 2], drawn[drawn.size() / 2], pictures[pictures.size() / 2]);
}

// Back and forth over the picture.
void sweep(test::Display& display, std::chrono::seconds time) {
    constexpr int steps = 200;
    const auto end = Clock::now() + time;
    for (int n = 0; Clock::now() < end; ++n) {
        const int along = n % (2 * steps) < steps ? n % steps : steps - n % steps;
        display.move(300 + 2 * along, 250);
        std::this_thread::sleep_for(15ms);
    }
}

int measure(const std::string& name, std::chrono::seconds time) {
    const bench::Workload drawn = bench::workload(name);
    constexpr std::int64_t edge = 256;
    test::TemporaryFolder folder;
    const auto file = [&](const char* what) { return (folder.path() / what).string(); };
    const link::Secret secret = link::Secret::random();
    std::ofstream(file("secret")) << secret.text() << "\n";
    std::filesystem::permissions(file("secret"), std::filesystem::perms::owner_read);
    std::ofstream(file("tf.toml")) << view::to_toml(view::AnchoredFunction{.tf = drawn.tf});
    deploy::LocalTree::Options options{.cube = drawn.cube(edge), .tree = {}, .log_level = "warn"};
    options.tree.tree = {2, 2};
    auto tree = deploy::LocalTree::start(options, secret);
    if (!tree) {
        fmt::print(stderr, "window_bench: {}\n", tree.error().message());
        return 2;
    }
    test::Display display(width, height);
    const test::Process window(
        {std::string(SHEARWATER_BIN) + "/shearwater-client", "--connect", wire::to_string(tree->address()),
         "--secret-file", file("secret"), "--size", fmt::format("{}x{}", width, height), "--scale", "1",
         "--tf", file("tf.toml"), "--pass-log", file("passes")},
        {{"DISPLAY", display.name()},
         {"LIBGL_ALWAYS_SOFTWARE", "1"},
         {"XDG_STATE_HOME", file("state")},
         {"XDG_CONFIG_HOME", file("config")}},
        file("log"));
    const auto phase = [&](const char* words, const auto& act) {
        const std::size_t from = seconds_of(file("passes")).size() + 1;
        act();
        std::this_thread::sleep_for(1200ms);
        const std::vector<Second> all = seconds_of(file("passes"));
        const auto to = std::min(all.size(), from + static_cast<std::size_t>(time.count()) - 1);
        print(name, words, std::span(all).subspan(std::min(from, to), to - std::min(from, to)));
    };
    std::this_thread::sleep_for(8s);  // loaded, and seen as good as it gets
    phase("turning", [&] {
        display.press(1, 300, 250);
        sweep(display, time);
        display.release(1);
    });
    std::this_thread::sleep_for(2s);
    phase("at rest", [&] { sweep(display, time); });
    phase("stopped", [&] {
        kill(tree->server_id(), SIGSTOP);
        display.press(1, 300, 250);
        sweep(display, time);
        display.release(1);
        kill(tree->server_id(), SIGCONT);
    });
    return 0;
}

int run(std::chrono::seconds time) {
    if (const std::string why = test::Display::unavailable(); !why.empty()) {
        fmt::print(stderr, "window_bench: {}\n", why);
        return 2;
    }
    fmt::print("{:>4} {:>9} {:>9} {:>9} {:>9} {:>9} {:>11}\n", "cube", "", "seconds", "least/s", "median/s",
               "drawn/s", "pictures/s");
    for (const char* name : {"W1", "W2"}) {
        if (const int status = measure(name, time); status != 0) {
            return status;
        }
    }
    return 0;
}

}  // namespace
}  // namespace shearwater

int main(int argc, char** argv) {
    return shearwater::run(std::chrono::seconds(argc > 1 ? std::max(3, std::atoi(argv[1])) : 12));
}
