#pragma once
// The window's thread: collects what the network has, draws, and leaves wishes.

#include <string>

#include "client/model/anchoring.h"
#include "client/view/desk.h"
#include "client/view/files.h"
#include "client/view/network.h"
#include "client/view/window.h"

namespace shearwater::ui {

struct AppOptions {
    view::AnchoredFunction tf{.tf = view::default_transfer_function()};
    std::optional<bool> level_of_detail;
    view::Classify classify = view::Classify::post;
    culling::Settings culling;
    model::Effort effort;
    std::optional<scene::Scene> scene;  // to begin with, read from:
    std::string session;
    std::string controls;    // a file that tells where the controls are; none when empty
    std::string screenshot;  // a file to write the window to once a whole high picture is seen; then it ends
};

class App {
  public:
    App(Window& window, Network& network, AppOptions options);

    // Until the window is closed, or the screenshot is taken or has become impossible.
    base::Status run();

  private:
    double patience() const;
    void collect();
    void upload();
    void widgets();
    void keys();
    void on_key(const KeyPress& press);
    void on_control_key(const KeyPress& press);
    void on_picked(const model::Picked& picked);
    void remember();
    void send_wish();
    bool is_settled() const;

    Window& window_;
    Network& network_;
    const AppOptions options_;
    PresetShelf presets_;
    FlightFiles flights_;
    Desk desk_;
    Files files_;
    model::Wish picture_wish_;  // of the last picture
    model::Anchoring anchoring_;
    model::Wish sent_;
    model::Effort sent_effort_;
    std::optional<view::Lattice> known_lattice_;
    double active_until_ = 0;  // seconds of ImGui's clock
    int settled_passes_ = 0;
    bool fault_told_ = false;  // of the function that the window was opened with
};

}  // namespace shearwater::ui
