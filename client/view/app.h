#pragma once
// What a window shows of one server, on the window's thread: collects what the network has, draws, and leaves
// wishes.

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
    std::optional<scene::Pair> pair;  // these two in place of the scene's
    model::Crop crop;
};

class App {
  public:
    // Without a network there is nothing to see.
    App(Window& window, std::unique_ptr<Network> network, AppOptions options);

    // How long the window may wait for input before a pass, in seconds.
    double patience() const;
    // One pass of widgets, between the window's begin() and draw(). `dropped`: sessions.
    void pass(const std::vector<std::string>& dropped);
    Desk& desk() { return desk_; }
    // The newest view is seen, whole and as good as it gets.
    bool is_settled() const;
    // Why the function that the window was opened with cannot be used, or empty.
    const std::string& fault() const { return anchoring_.fault(); }
    // The link ends with what is given.
    std::unique_ptr<Network> release_network() { return std::move(network_); }

  private:
    void collect();
    void upload();
    void widgets();
    void keys();
    void on_key(const KeyPress& press);
    void on_control_key(const KeyPress& press);
    void on_picked(const model::Picked& picked);
    void remember();
    void send_wish();

    Window& window_;
    std::unique_ptr<Network> network_;  // or none
    const AppOptions options_;
    PresetShelf presets_;
    FlightFiles flights_;
    Desk desk_;
    Files files_;
    model::Wish picture_wish_;  // of the last picture
    model::Anchoring anchoring_;
    model::Wish sent_;
    model::Effort sent_effort_;
    std::optional<view::Lattice> known_lattice_;  // of the cube shown
    std::string known_name_;
    double active_until_ = 0;  // seconds of ImGui's clock
    bool fault_told_ = false;  // of the function that the window was opened with
    bool crop_told_ = false;   // whether the cube has what it is to be cropped to
};

}  // namespace shearwater::ui
