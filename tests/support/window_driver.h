#pragma once
// A virtual display with synthetic mouse and keys, and processes on it, for tests that drive a real window.

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "tests/support/temporary_folder.h"

namespace shearwater::test {

using Picture = image::Image<image::Rgba8>;
using support::TemporaryFolder;

// A child process in a group of its own; the whole group is killed with the object.
class Process {
  public:
    // Output of both kinds goes to `log`. `environment` is added to ours.
    Process(const std::vector<std::string>& command, const std::map<std::string, std::string>& environment,
            const std::filesystem::path& log);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void kill_group();
    bool running();
    // The exit status, or nothing when it has not ended by then (or was killed).
    std::optional<int> wait(std::chrono::seconds limit);

  private:
    int pid_ = -1;
    std::optional<int> status_;
};

class Display {
  public:
    // Why no display can be had here, or empty.
    static std::string unavailable();

    Display(int width, int height);
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    const std::string& name() const { return name_; }  // ":7"
    Picture grab() const;

    // A key, held as long as a person holds it.
    // The mouse is in the upper left corner before and after each of these: its pointer is on the screen.
    void key(const std::string& name) { xdotool({"key", "--delay", "400", name}); }
    // Shorter than many a pass.
    void tap(const std::string& name) { xdotool({"key", "--delay", "20", name}); }
    // Characters, wherever they are typed into.
    void type(const std::string& text) { xdotool({"type", "--delay", "30", "--", text}); }
    void hold(const std::string& key, std::chrono::milliseconds time);
    // Presses `button` at (x, y), moves by (dx, dy) in steps and lets go.
    void drag(int button, int x, int y, int dx, int dy, const std::string& held_key = "");
    void click(int x, int y, int times = 1, int button = 1);
    void wheel(int x, int y, int notches);  // upwards when positive
    // A drag by parts: presses at (x, y), moves to others, lets go.
    void press(int button, int x, int y);
    void move(int x, int y) { xdotool({"mousemove", std::to_string(x), std::to_string(y)}); }
    void release(int button);

    // A window by words of its title, once it is there.
    void place_window(const std::string& title, int x, int y, int width, int height);
    void hide_and_show(const std::string& title);

  private:
    void park();
    void xdotool(const std::vector<std::string>& arguments);

    TemporaryFolder folder_;
    std::unique_ptr<Process> server_;
    std::string name_;
};

}  // namespace shearwater::test
