#include <CLI/CLI.hpp>
#include <optional>

#include "common/options/drawing_options.h"
#include "common/scene/file.h"
#include "deploy/commands.h"
#include "deploy/target.h"
#include "protocol/daemon/runtime.h"

namespace shearwater::deploy {
namespace {

const std::string view_program = "shearwater view";

struct ViewFlags {
    TargetOptions target;
    options::DrawingOptions drawing;
    double target_rate = 20;
    std::string session;
};

// Starts the window and waits until it closes; a local tree is kept alive meanwhile.
base::Result<int> view(const ViewFlags& flags) {
    if (const auto valid = flags.target.validate(); !valid) {
        return valid.error();
    }
    if (!flags.session.empty()) {  // before a tree is started for it
        if (const auto readable = scene::read(flags.session); !readable) {
            return readable.error();
        }
    }
    auto target = open_target(flags.target, "info");
    if (!target) {
        return target.error();
    }
    std::vector<std::string> arguments;
    if (target->server.command.empty()) {
        arguments = {"--connect", wire::to_string(target->server)};
    }
    if (flags.session.empty()) {
        const std::vector<std::string> drawing = flags.drawing.arguments();
        arguments.insert(arguments.end(), drawing.begin(), drawing.end());
        arguments.insert(arguments.end(), {"--target-rate", std::to_string(flags.target_rate)});
    } else {
        arguments.insert(arguments.end(), {"--session", flags.session});
    }
    if (!target->server.command.empty()) {
        arguments.emplace_back("--");
        arguments.insert(arguments.end(), target->server.command.begin(), target->server.command.end());
    }
    auto window = Process::start("shearwater-client", arguments, target->secret);
    if (!window) {
        return window.error();
    }
    bool server_gone = false;
    std::optional<int> status;
    std::optional<daemon::Runtime> runtime;
    runtime.emplace(view_program, target->secret, [&](const wire::NetEvent&) {
        status = status ? status : window->ended();
        if (target->tree && !target->tree->keep_alive()) {
            server_gone = true;
        }
        if (status || server_gone) {
            runtime->stop(0);
        }
    });
    runtime->run();
    if (server_gone) {
        return base::error(base::Code::io, "view", "the server process ended unexpectedly");
    }
    return status.value_or(0);
}

}  // namespace

Run add_view(CLI::App& app) {
    auto flags = std::make_shared<ViewFlags>();
    flags->drawing.add_to(app);
    app.add_option("--target-rate", flags->target_rate,
                   "frames a second to hold while the view moves, by lesser quality where need be")
        ->check(CLI::Range(1.0, 60.0))
        ->capture_default_str();
    std::vector<std::string> said_by_session = options::DrawingOptions::names();
    said_by_session.emplace_back("--target-rate");
    options::add_session(app, flags->session, said_by_session);
    flags->target.add_to(app);
    return [flags] {
        const auto status = view(*flags);
        return status ? *status : refuse(view_program, status.error());
    };
}

}  // namespace shearwater::deploy
