#include "client/view/viewer.h"

#include <algorithm>
#include <filesystem>
#include <tuple>
#include <utility>

#include "common/base/own_program.h"
#include "common/image/png.h"

namespace shearwater::ui {

namespace {

using model::Place;

std::string absolute(const std::string& path) {
    std::error_code none;
    return path.empty() ? path : std::filesystem::absolute(path, none).string();
}

// Only a server that runs already has one of its own.
base::Result<link::Secret> secret_of_server(const std::string& file) {
    auto secret = link::Secret::find(file);
    if (!secret && file.empty()) {
        return base::error(base::Code::not_found, "",
                           "Type the secret of that server, or name the file it is in.");
    }
    return secret;
}

}  // namespace

Connecting connecting_to(const Place& place, link::Secret secret, std::string secret_file) {
    Connecting to{.route = {},
                  .redial = model::Redial::once_linked,
                  .secret = std::move(secret),
                  .recent = {place.name, absolute(secret_file)},
                  .note = {},
                  .advice = model::advice(place)};
    const std::vector<std::string> arguments{
        place.kind == Place::Kind::elsewhere ? place.there.path : place.name, "--log", "info"};
    switch (place.kind) {
        case Place::Kind::server:
            to.route = place.address;
            break;
        case Place::Kind::here:
            to.route = wire::Route(wire::serving_here(base::beside_this_program("shearwater"), arguments));
            break;
        case Place::Kind::elsewhere:
            to.route = wire::Route(wire::serving_there({}, place.there.host, arguments));
            to.note = "ssh may ask for a password in the terminal that this window was started from.";
            break;
    }
    return to;
}

Viewer::Viewer(Window& window, ViewerOptions options, std::optional<Connecting> first)
    : window_(window),
      options_(std::move(options)),
      app_options_(options_.app),
      recent_file_(Window::wake),
      eye_windows_(window),
      pass_log_(options_.pass_log) {
    const bool asks = !first;
    begin(std::move(first));
    if (asks) {
        dialog_.open();
    }
}

base::Status Viewer::run() {
    while (!window_.is_closing()) {
        constexpr double soon = 0.03;
        window_.begin(options_.screenshot.empty() ? app_->patience() : std::min(app_->patience(), soon));
        collect();
        app_->desk().in_dialog = dialog_.is_open();
        eye_windows_.attend(app_->desk());
        app_->pass(take_dropped_sessions());
        const ConnectionDialog::Wish wish =
            dialog_.draw(app_->desk(), recent_.list.all(), recent_.fault, connecting_.has_value());
        if (!options_.controls.empty()) {
            if (auto written = app_->desk().controls.write(options_.controls); !written) {
                return written;
            }
        }
        const Desk& desk = app_->desk();
        const bool drawn = window_.draw({.uploads = desk.picture.uploads() + desk.right_picture.uploads(),
                                         .for_each_eye = desk.shown == image::StereoMode::quad_buffered,
                                         .anyway = !options_.screenshot.empty()});
        if (auto done = screenshot()) {
            return *std::move(done);
        }
        if (drawn) {
            window_.show();
            eye_windows_.show(desk);
        }
        const bool has_new_picture = desk.picture_revision != shown_picture_;
        shown_picture_ = desk.picture_revision;
        if (auto counted = pass_log_.count({.drawn = drawn, .has_new_picture = has_new_picture}); !counted) {
            return counted;
        }
        watch();
        act(wish);
    }
    return {};
}

void Viewer::collect() {
    while (auto outcome = recent_file_.collect()) {
        recent_ = *std::move(outcome);
    }
    std::erase_if(endings_, [](const std::future<void>& ending) {
        return ending.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    });
}

// Cubes are connected to once this pass is over.
std::vector<std::string> Viewer::take_dropped_sessions() {
    std::vector<std::string> sessions = window_.take_drops();
    std::erase_if(sessions, [this](const std::string& path) {
        const bool is_cube = model::is_named_as_cube(path);
        dropped_cube_ = is_cube ? std::optional(path) : dropped_cube_;
        return is_cube;
    });
    return sessions;
}

// What a pass has asked for, when nothing of it is drawn any more.
void Viewer::act(const ConnectionDialog::Wish& wish) {
    const bool asked = app_->desk().connect_elsewhere, cancelled = app_->desk().cancel;
    if (wish.forget) {
        recent_file_.remove(*wish.forget);
    }
    if (auto cube = std::exchange(dropped_cube_, std::nullopt)) {
        connect({*cube, ""}, false);
    } else if (wish.connect) {
        connect(*wish.connect, wish.typed_secret);
    } else if (wish.close) {
        dialog_.close();
    } else if (cancelled) {
        const model::Recent given_up = connecting_ ? connecting_->recent : model::Recent();
        begin(std::nullopt);
        dialog_.open(given_up);
    } else if (asked && !dialog_.is_open()) {
        ask();
    }
}

void Viewer::ask() {
    app_->desk().flying = false;
    dialog_.open();
}

void Viewer::connect(const model::Recent& recent, bool typed_secret) {
    const auto place = model::place_from(recent.name, here());
    if (!place) {
        return dialog_.reopen(place.error().message(), "");
    }
    const bool has_own = place->kind == Place::Kind::server;
    auto secret = !has_own       ? link::Secret::random()
                  : typed_secret ? dialog_.take_secret()
                                 : secret_of_server(recent.secret_file);
    if (!secret) {
        return dialog_.open(recent, secret.error().message(), "");
    }
    dialog_.close();
    begin(connecting_to(*place, *std::move(secret), has_own ? recent.secret_file : ""));
}

// The old link ends beside: to find an address may take a while, and nobody waits for it.
void Viewer::begin(std::optional<Connecting> next) {
    std::optional<std::tuple<bool, bool, int>> shown;
    if (app_) {
        Desk& desk = app_->desk();
        shown = {desk.panel, desk.dock, desk.dock_tab};
        if (auto old = app_->release_network()) {
            endings_.push_back(
                std::async(std::launch::async, [network = std::move(old)]() mutable { network.reset(); }));
        }
        app_.reset();
    }
    connecting_ = std::move(next);
    has_been_linked_ = false;
    std::unique_ptr<Network> network;
    if (connecting_) {
        network = std::make_unique<Network>(connecting_->route, connecting_->redial, connecting_->recent.name,
                                            connecting_->secret, Window::wake);
    }
    app_ = std::make_unique<App>(window_, std::move(network), app_options_);
    if (connecting_) {
        app_->desk().waiting_note = connecting_->note;
        app_options_.scene.reset();
        app_options_.pair.reset();
        app_options_.crop.reset();
    }
    if (shown) {
        std::tie(app_->desk().panel, app_->desk().dock, app_->desk().dock_tab) = *shown;
    }
}

// What a link has come to: one that comes up is kept in mind, and where none has come about the dialog says
// why.
void Viewer::watch() {
    const model::Status& status = app_->desk().status;
    if (has_been_linked_ || !connecting_) {
        return;
    }
    if (status.connection == model::Connection::connected) {
        has_been_linked_ = true;
        if (!connecting_->recent.name.empty()) {
            recent_file_.add(connecting_->recent);
        }
    } else if (status.connection == model::Connection::refused) {
        const std::string words = status.words;
        const Connecting failed = *connecting_;
        begin(std::nullopt);
        dialog_.open(failed.recent, words, failed.advice);
    }
}

std::optional<base::Status> Viewer::screenshot() {
    if (options_.screenshot.empty()) {
        return std::nullopt;
    }
    constexpr int passes_to_settle = 3;
    settled_passes_ = app_->is_settled() ? settled_passes_ + 1 : 0;
    if (settled_passes_ >= passes_to_settle) {
        return image::write_png(options_.screenshot, window_.read_pixels());
    }
    const auto impossible = [](base::Code code, const std::string& why) {
        return base::Status(base::error(code, "take the screenshot", why));
    };
    const model::Status& status = app_->desk().status;
    if (status.connection == model::Connection::refused) {
        return impossible(base::Code::refused, status.words);
    }
    if (!app_->fault().empty()) {
        return impossible(base::Code::unsupported, app_->fault());
    }
    return std::nullopt;
}

}  // namespace shearwater::ui
