// shearwater-client: the window on a running server.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "client/view/viewer.h"
#include "common/options/crop_option.h"
#include "common/options/drawing_options.h"
#include "common/options/stereo_options.h"
#include "common/scene/file.h"

namespace {

using namespace shearwater;

constexpr int unusable = 2;

struct Options {
    std::vector<std::string> command;
    std::string connect, place, secret_file, screenshot, controls, pass_log, session;
    std::string size = "1280x800";
    options::DrawingOptions drawing;
    options::StereoOptions stereo;
    options::CropOption crop;
    ui::WindowOptions window;
    model::Effort effort;
};

std::string check_size(const std::string& text) {
    int width = 0, height = 0;
    char rest = 0;
    const bool good = std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) == 2 && width >= 320 &&
                      height >= 240 && width <= 8192 && height <= 8192;
    return good ? "" : "the size should read WIDTHxHEIGHT, from 320x240 to 8192x8192";
}

void declare(CLI::App& app, Options& options) {
    auto* const connect = app.add_option("--connect", options.connect, "The server, HOST:PORT");
    auto* const command =
        app.add_option("command", options.command,
                       "Behind --: instead, the words of a program whose standard streams lead to a server")
            ->excludes(connect);
    app.add_option("--place", options.place,
                   "What that command leads to, as it can be typed into the connection dialog")
        ->needs(command);
    app.add_option(
        "--secret-file", options.secret_file,
        fmt::format("A file of mode 0600 with the server's secret; else ${}", link::Secret::variable));
    options.drawing.add_to(app);
    options.stereo.add_to(app);
    options.crop.add_to(app);
    app.add_option("--size", options.size, "The window's size")->check(check_size)->capture_default_str();
    app.add_option("--scale", options.window.scale, "Pixels per nominal pixel; else as the display says")
        ->check(CLI::Range(0.5, 4.0));
    app.add_option("--target-rate", options.effort.target_rate,
                   "Frames a second to hold while the view moves, by lesser quality where need be")
        ->check(CLI::Range(model::Effort::min_rate, model::Effort::max_rate))
        ->capture_default_str();
    std::vector<std::string> said_by_session = options::DrawingOptions::names();
    said_by_session.emplace_back("--target-rate");
    options::add_session(app, options.session, said_by_session);
    app.add_option("--controls", options.controls,
                   "Keep in this file where each control is, for scripts: NAME X Y WIDTH HEIGHT");
    app.add_option("--pass-log", options.pass_log,
                   "Keep in this file how often the window is drawn: SECOND PASSES DRAWN PICTURES, a line each");
    app.add_option("--screenshot", options.screenshot,
                   "Write the window to this PNG file once the first whole picture is seen, and end");
    app.footer("With neither a server nor a command the window asks where the cube is.");
}

// A server that runs: until it answers it is dialled again, since it may have been started with the window.
base::Result<ui::Connecting> by_address(const Options& options) {
    const auto address = wire::parse_address(options.connect, 0);
    if (!address) {
        return address.error();
    }
    if (address->port == 0) {
        return base::error(base::Code::invalid_argument, "address '" + options.connect + "'",
                           "the port is missing");
    }
    auto secret = link::Secret::find(options.secret_file);
    if (!secret) {
        return secret.error();
    }
    ui::Connecting to = ui::connecting_to({.kind = model::Place::Kind::server,
                                           .name = wire::to_string(*address),
                                           .address = *address,
                                           .there = {}},
                                          *std::move(secret), options.secret_file);
    to.redial = model::Redial::always;
    return to;
}

// A server that a command starts is told a secret of its own.
base::Result<ui::Connecting> by_command(const Options& options) {
    ui::Connecting to{.route = wire::Route(options.command),
                      .redial = model::Redial::once_linked,
                      .secret = link::Secret::random(),
                      .recent = {},
                      .note = {},
                      .advice = {}};
    if (!options.place.empty()) {
        const auto place = model::place_from(options.place, ui::here());
        if (!place) {
            return place.error();
        }
        to = ui::connecting_to(*place, to.secret, "");
        to.route = wire::Route(options.command);
    }
    return to;
}

base::Result<std::optional<ui::Connecting>> first_server(const Options& options) {
    if (options.command.empty() && options.connect.empty()) {
        if (!options.screenshot.empty()) {
            return base::error(base::Code::invalid_argument, "--screenshot",
                               "name a server to take it of, or a command");
        }
        return std::optional<ui::Connecting>();
    }
    auto to = options.command.empty() ? by_address(options) : by_command(options);
    if (!to) {
        return to.error();
    }
    return std::optional(*std::move(to));
}

base::Status run(Options options) {
    std::sscanf(options.size.c_str(), "%dx%d", &options.window.width, &options.window.height);
    auto tf = options.drawing.transfer_function();
    if (!tf) {
        return tf.error();
    }
    auto first = first_server(options);
    if (!first) {
        return first.error();
    }
    std::optional<scene::Scene> scene;
    if (!options.session.empty()) {
        auto read = scene::read(options.session);
        if (!read) {
            return read.error();
        }
        scene = *std::move(read);
    }
    auto window = ui::Window::open(options.window);
    if (!window) {
        return window.error();
    }
    ui::Viewer viewer(**window,
                      {.app = {.tf = std::move(*tf),
                               .level_of_detail = options.drawing.level_of_detail(),
                               .classify = options.drawing.classification(),
                               .culling = options.drawing.culling_settings(),
                               .effort = options.effort,
                               .scene = std::move(scene),
                               .session = options.session,
                               .pair = options.stereo.pair(),
                               .crop = options.crop.box()},
                       .controls = options.controls,
                       .pass_log = options.pass_log,
                       .screenshot = options.screenshot},
                      *std::move(first));
    return viewer.run();
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("The window on a Shearwater server", "shearwater-client");
    declare(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp& asked) {
        return app.exit(asked);
    } catch (const CLI::ParseError& fault) {
        fmt::print(stderr, "shearwater-client: {}\n", fault.what());
        return unusable;
    }
    if (const auto status = run(options); !status) {
        fmt::print(stderr, "shearwater-client: {}\n", status.error().message());
        return unusable;
    }
    return 0;
}
