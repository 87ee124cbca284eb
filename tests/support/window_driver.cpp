#include "tests/support/window_driver.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <thread>

namespace shearwater::test {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace {

bool on_path(const std::string& program) {
    const char* path = std::getenv("PATH");
    std::string rest = path != nullptr ? path : "";
    while (!rest.empty()) {
        const std::size_t end = rest.find(':');
        if (access((rest.substr(0, end) + "/" + program).c_str(), X_OK) == 0) {
            return true;
        }
        rest = end == std::string::npos ? "" : rest.substr(end + 1);
    }
    return false;
}

std::string contents(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return std::move(text).str();
}

// In the child, between fork and exec.
[[noreturn]] void become(std::vector<char*> command, const std::map<std::string, std::string>& environment,
                         const char* log) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int out = open(log, O_WRONLY | O_CREAT | O_APPEND, 0644);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    for (const auto& [name, value] : environment) {
        setenv(name.c_str(), value.c_str(), 1);
    }
    execvp(command[0], command.data());
    _exit(127);
}

// A 32-bit word of an X window dump's header.
std::uint32_t word(const std::string& dump, std::size_t index) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        value = (value << 8) | static_cast<std::uint8_t>(dump.at(index * 4 + i));
    }
    return value;
}

}  // namespace

Process::Process(const std::vector<std::string>& command,
                 const std::map<std::string, std::string>& environment, const fs::path& log) {
    std::vector<std::string> words = command;
    std::vector<char*> pointers;
    for (std::string& w : words) {
        pointers.push_back(w.data());
    }
    pointers.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
        become(pointers, environment, log.c_str());
    }
    setpgid(pid_, pid_);
}

Process::~Process() {
    kill_group();
    wait(10s);
}

void Process::kill_group() {
    ::kill(-pid_, SIGKILL);
}

bool Process::running() {
    return !wait(0s) && !status_;
}

std::optional<int> Process::wait(std::chrono::seconds limit) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!status_) {
        int status = 0;
        if (waitpid(pid_, &status, WNOHANG) == pid_) {
            status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        } else if (std::chrono::steady_clock::now() >= end) {
            return std::nullopt;
        } else {
            std::this_thread::sleep_for(10ms);
        }
    }
    return *status_ >= 0 ? status_ : std::nullopt;
}

std::string Display::unavailable() {
    for (const char* program : {"Xvfb", "xdotool"}) {
        if (!on_path(program)) {
            return std::string(program) + " is not installed";
        }
    }
    return {};
}

Display::Display(int width, int height) {
    const fs::path announced = folder_ / "number";
    const std::string screen = std::to_string(width) + "x" + std::to_string(height) + "x24";
    // Xvfb takes a free number and writes it to the descriptor once it is ready; the shell gives it a file.
    server_ = std::make_unique<Process>(
        std::vector<std::string>{"sh", "-c",
                                 "exec Xvfb -displayfd 3 -screen 0 " + screen + " -fbdir " +
                                     folder_.path().string() + " -nolisten tcp -noreset 3>" +
                                     announced.string()},
        std::map<std::string, std::string>{}, folder_ / "xvfb.log");
    while (contents(announced).find('\n') == std::string::npos) {
        if (!server_->running()) {
            throw std::runtime_error("Xvfb ended: " + contents(folder_ / "xvfb.log"));
        }
        std::this_thread::sleep_for(20ms);
    }
    const std::string number = contents(announced);
    name_ = ":" + number.substr(0, number.find('\n'));
}

Display::~Display() = default;

// Xvfb keeps its screen in a file, as an X window dump.
Picture Display::grab() const {
    const std::string dump = contents(folder_ / "Xvfb_screen0");
    const std::uint32_t header = word(dump, 0), width = word(dump, 4), height = word(dump, 5);
    const std::uint32_t pitch = word(dump, 12), colours = word(dump, 19);
    const bool little_endian = word(dump, 7) == 0;
    Picture picture(static_cast<int>(width), static_cast<int>(height));
    std::size_t at = header + std::size_t{colours} * 12;
    for (int y = 0; y < picture.height(); ++y, at += pitch) {
        const std::string_view row = std::string_view(dump).substr(at, 4 * std::size_t{width});
        auto pixel = picture.row(y).begin();
        for (std::size_t x = 0; x + 4 <= row.size(); x += 4) {
            const auto byte = [&](std::size_t i) {
                return static_cast<std::uint8_t>(row[x + (little_endian ? i : 3 - i)]);
            };
            *pixel++ = {byte(2), byte(1), byte(0), 255};
        }
    }
    return picture;
}

void Display::xdotool(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{"xdotool"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    Process tool(command, {{"DISPLAY", name_}}, folder_ / "xdotool.log");
    if (tool.wait(60s) != 0) {
        throw std::runtime_error("xdotool failed: " + contents(folder_ / "xdotool.log"));
    }
}

void Display::park() {
    xdotool({"sleep", "0.1", "mousemove", "1", "1"});
}

void Display::drag(int button, int x, int y, int dx, int dy, const std::string& held_key) {
    constexpr int steps = 8;
    std::vector<std::string> words{"mousemove", std::to_string(x), std::to_string(y), "sleep", "0.1"};
    const auto add = [&](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
    if (!held_key.empty()) {
        add({"keydown", held_key, "sleep", "0.1"});
    }
    add({"mousedown", std::to_string(button), "sleep", "0.25"});
    for (int i = 1; i <= steps; ++i) {
        add({"mousemove", std::to_string(x + dx * i / steps), std::to_string(y + dy * i / steps), "sleep",
             "0.03"});
    }
    add({"sleep", "0.25", "mouseup", std::to_string(button)});
    if (!held_key.empty()) {
        add({"sleep", "0.1", "keyup", held_key});
    }
    xdotool(words);
    park();
}

void Display::hold(const std::string& key, std::chrono::milliseconds time) {
    const double seconds = std::chrono::duration<double>(time).count();
    xdotool({"keydown", key, "sleep", std::to_string(seconds), "keyup", key});
}

void Display::press(int button, int x, int y) {
    xdotool({"mousemove", std::to_string(x), std::to_string(y), "sleep", "0.1", "mousedown",
             std::to_string(button), "sleep", "0.25"});
}

void Display::release(int button) {
    xdotool({"mouseup", std::to_string(button)});
    park();
}

void Display::place_window(const std::string& title, int x, int y, int width, int height) {
    xdotool({"search", "--sync", "--name", title, "windowmove", std::to_string(x), std::to_string(y),
             "windowsize", std::to_string(width), std::to_string(height)});
}

void Display::hide_and_show(const std::string& title) {
    xdotool({"search", "--sync", "--name", title, "windowunmap", "--sync", "windowmap", "--sync"});
}

void Display::click(int x, int y, int times, int button) {
    const std::string which = std::to_string(button);
    std::vector<std::string> words{"mousemove", std::to_string(x), std::to_string(y), "sleep", "0.2"};
    const auto add = [&](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
    // As long as a pass of a busy machine; two clicks may be half a second apart.
    const std::string held = times == 1 ? "0.2" : "0.15";
    for (int i = 0; i < times; ++i) {
        add({"mousedown", which, "sleep", held, "mouseup", which, "sleep", "0.15"});
    }
    xdotool(words);
    park();
}

void Display::wheel(int x, int y, int notches) {
    xdotool({"mousemove", std::to_string(x), std::to_string(y), "sleep", "0.1", "click", "--repeat",
             std::to_string(std::abs(notches)), "--delay", "40", notches > 0 ? "4" : "5"});
    park();
}

}  // namespace shearwater::test
