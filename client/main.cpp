// shearwater-client: the window on a running server.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "client/view/app.h"

namespace {

using namespace shearwater;

constexpr int unusable = 2;

struct Options {
    std::string connect, secret_file, tf_file, screenshot, controls;
    std::string size = "1280x800";
    std::string classify = "post";
    std::string lod;
    std::string culling = "off";
    double culling_threshold = culling::Settings::default_threshold;
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
    app.add_option("--connect", options.connect, "The server, HOST:PORT")->required();
    app.add_option(
        "--secret-file", options.secret_file,
        fmt::format("A file of mode 0600 with the server's secret; else ${}", link::Secret::variable));
    app.add_option("--tf", options.tf_file, "Begin with the transfer function of this TOML file");
    app.add_option("--classify", options.classify,
                   "Where the transfer function applies: to samples, or to all values between two")
        ->check(CLI::IsMember({"post", "pre-integrated"}))
        ->capture_default_str();
    app.add_option("--lod", options.lod,
                   "off: every voxel counts, however small in the picture; else as the server has it")
        ->check(CLI::IsMember({"on", "off"}));
    app.add_option("--culling", options.culling,
                   "Leave out blocks hidden behind others, found by such functions of their opacity")
        ->check(
            CLI::IsMember(std::vector<std::string>(culling::kind_names.begin(), culling::kind_names.end())))
        ->capture_default_str();
    app.add_option(
           "--culling-threshold", options.culling_threshold,
           "Opacity that hides what is behind; the default changes no picture by more than a level of 255")
        ->check(CLI::Range(0.5, 0.999999));
    app.add_option("--size", options.size, "The window's size")->check(check_size)->capture_default_str();
    app.add_option("--scale", options.window.scale, "Pixels per nominal pixel; else as the display says")
        ->check(CLI::Range(0.5, 4.0));
    app.add_option("--target-rate", options.effort.target_rate,
                   "Frames a second to hold while the view moves, by lesser quality where need be")
        ->check(CLI::Range(model::Effort::min_rate, model::Effort::max_rate))
        ->capture_default_str();
    app.add_option("--controls", options.controls,
                   "Keep in this file where each control is, for scripts: NAME X Y WIDTH HEIGHT");
    app.add_option("--screenshot", options.screenshot,
                   "Write the window to this PNG file once the first whole picture is seen, and end");
}

base::Result<view::TransferFunction> read_tf(const std::string& path) {
    if (path.empty()) {
        return view::default_transfer_function();
    }
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!file) {
        return base::error(base::Code::io, "read transfer function " + path, "the file cannot be read");
    }
    return view::transfer_function_from_toml(text, path);
}

base::Status run(Options options) {
    std::sscanf(options.size.c_str(), "%dx%d", &options.window.width, &options.window.height);
    auto tf = read_tf(options.tf_file);
    if (!tf) {
        return tf.error();
    }
    const auto server = wire::parse_address(options.connect, 0);
    if (!server) {
        return server.error();
    }
    if (server->port == 0) {
        return base::error(base::Code::invalid_argument, "address '" + options.connect + "'",
                           "the port is missing");
    }
    auto secret = link::Secret::find(options.secret_file);
    if (!secret) {
        return secret.error();
    }
    auto window = ui::Window::open(options.window);
    if (!window) {
        return window.error();
    }
    ui::Network network(*server, std::move(*secret), ui::Window::wake);
    ui::App app(
        **window, network,
        {.tf = std::move(*tf),
         .level_of_detail = options.lod.empty() ? std::nullopt : std::optional(options.lod == "on"),
         .classify = options.classify == "post" ? view::Classify::post : view::Classify::pre_integrated,
         .culling = {static_cast<culling::Kind>(
                         std::find(culling::kind_names.begin(), culling::kind_names.end(), options.culling) -
                         culling::kind_names.begin()),
                     options.culling_threshold},
         .effort = options.effort,
         .controls = options.controls,
         .screenshot = options.screenshot});
    return app.run();
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("The window on a running Shearwater server", "shearwater-client");
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
