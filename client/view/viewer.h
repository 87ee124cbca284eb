#pragma once
// The window's thread: shows one server after another, and asks for the next.

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/model/recent.h"
#include "client/view/app.h"
#include "client/view/connection_dialog.h"
#include "client/view/eye_windows.h"
#include "client/view/pass_log.h"
#include "client/view/recent_file.h"

namespace shearwater::ui {

// A server to dial.
struct Connecting {
    wire::Route route;
    model::Redial redial;
    link::Secret secret;
    model::Recent recent;  // to be kept once there is a link; its name is empty where it is not
    std::string note;      // what else there is to know while it is waited for
    std::string advice;    // what to try when it cannot be reached
};

// To what the dialog asks for: a command that serves the cube, here or by ssh, or an address.
Connecting connecting_to(const model::Place& place, link::Secret secret, std::string secret_file);

struct ViewerOptions {
    AppOptions app;          // its scene, pair and crop are the first cube's
    std::string controls;    // a file that tells where the controls are; none when empty
    std::string pass_log;    // a file that tells how often the window is drawn; none when empty
    std::string screenshot;  // a file to write the window to once a whole high picture is seen; then it ends
};

class Viewer {
  public:
    // Asks where there is nothing to begin with.
    Viewer(Window& window, ViewerOptions options, std::optional<Connecting> begin);

    // Until the window is closed, or the screenshot is taken or has become impossible.
    base::Status run();

  private:
    void collect();
    std::vector<std::string> take_dropped_sessions();
    void act(const ConnectionDialog::Wish& wish);
    void ask();
    void connect(const model::Recent& recent, bool typed_secret);
    void begin(std::optional<Connecting> next);
    void watch();
    std::optional<base::Status> screenshot();

    Window& window_;
    const ViewerOptions options_;
    AppOptions app_options_;
    RecentFile recent_file_;
    RecentFile::Outcome recent_;
    ConnectionDialog dialog_;
    std::optional<Connecting> connecting_;  // what is shown, or waited for
    bool has_been_linked_ = false;
    std::optional<std::string> dropped_cube_;
    int settled_passes_ = 0;
    std::vector<std::future<void>> endings_;  // of links, which may take a while
    std::unique_ptr<App> app_;
    EyeWindows eye_windows_;
    PassLog pass_log_;
    std::uint64_t shown_picture_ = 0;  // the last
};

}  // namespace shearwater::ui
