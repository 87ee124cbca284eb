#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>

#include "common/base/own_program.h"
#include "common/cube/open.h"
#include "common/options/crop_option.h"
#include "common/options/drawing_options.h"
#include "common/options/stereo_options.h"
#include "common/scene/file.h"
#include "deploy/commands.h"
#include "deploy/target.h"

namespace shearwater::deploy {
namespace {

const std::string view_program = "shearwater view";

struct ViewFlags {
    TargetOptions target;
    options::DrawingOptions drawing;
    options::StereoOptions stereo;
    options::CropOption crop;
    double target_rate = 20;
    std::string session;
};

// What can be told before there is a window to say it.
base::Status check(const ViewFlags& flags) {
    const options::CubeOptions& cube = flags.target.cube;
    if (!cube.path.empty() || !flags.target.connect.empty()) {
        if (auto valid = flags.target.validate(); !valid) {
            return valid;
        }
    }
    if (!flags.session.empty()) {
        if (const auto readable = scene::read(flags.session); !readable) {
            return readable.error();
        }
    }
    if (cube.path.empty()) {
        return {};
    }
    if (const auto topology = flags.target.tree.topology(); !topology) {
        return topology.error();
    }
    if (!remote_cube(cube.path)) {
        const auto opened = cube::open(cube.path, cube.open_options());
        if (!opened) {
            return opened.error();
        }
        if (const auto crop = flags.crop.box_of({.n = opened->info.n}); !crop) {
            return crop.error();
        }
    }
    return {};
}

// The window's: it starts the tree of its cube itself, so that the one ends with the other. Nothing named: it
// asks.
std::vector<std::string> arguments_of(const ViewFlags& flags) {
    const TargetOptions& target = flags.target;
    std::vector<std::string> arguments;
    const auto add = [&](const std::vector<std::string>& more) {
        arguments.insert(arguments.end(), more.begin(), more.end());
    };
    if (!target.connect.empty()) {
        add({"--connect", target.connect});
    }
    if (!target.secret_file.empty()) {
        add({"--secret-file", target.secret_file});
    }
    if (flags.session.empty()) {
        add(flags.drawing.arguments());
        add({"--target-rate", std::to_string(flags.target_rate)});
    } else {
        add({"--session", flags.session});
    }
    add(flags.stereo.arguments());
    add(flags.crop.arguments());
    if (!target.cube.path.empty()) {
        add({"--place", target.cube.path, "--"});
        add(serving_command(target, "info"));
    }
    return arguments;
}

// Becomes the window; comes back only when it cannot.
base::Status view(const ViewFlags& flags) {
    if (auto usable = check(flags); !usable) {
        return usable;
    }
    const std::string program = "shearwater-client";
    std::vector<std::string> words{base::beside_this_program(program)};
    const std::vector<std::string> arguments = arguments_of(flags);
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) {
        pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);
    execv(pointers[0], pointers.data());
    return base::error(errno == ENOENT ? base::Code::not_found : base::Code::io, "start " + program,
                       std::strerror(errno));
}

}  // namespace

Run add_view(CLI::App& app) {
    auto flags = std::make_shared<ViewFlags>();
    flags->drawing.add_to(app);
    flags->stereo.add_to(app);
    flags->crop.add_to(app);
    app.add_option("--target-rate", flags->target_rate,
                   "frames a second to hold while the view moves, by lesser quality where need be")
        ->check(CLI::Range(1.0, 60.0))
        ->capture_default_str();
    std::vector<std::string> said_by_session = options::DrawingOptions::names();
    said_by_session.emplace_back("--target-rate");
    options::add_session(app, flags->session, said_by_session);
    flags->target.add_to(app);
    app.footer("Without a cube and --connect the window asks where the cube is.");
    return [flags] { return refuse(view_program, view(*flags).error()); };
}

}  // namespace shearwater::deploy
