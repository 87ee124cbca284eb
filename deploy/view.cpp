#include <optional>

#include "deploy/commands.h"
#include "deploy/target.h"
#include "deploy/view_options.h"
#include "protocol/daemon/runtime.h"

namespace shearwater::deploy {
namespace {

const std::string program = "shearwater view";

struct Flags {
    TargetOptions target;
    std::string tf_file;
    std::string classify = "post";
    std::string lod;
    CullingOptions culling;
    double target_rate = 20;
};

// Starts the window and waits until it closes; a local tree is kept alive meanwhile.
base::Result<int> view(const Flags& flags) {
    if (const auto valid = flags.target.validate(); !valid) {
        return valid.error();
    }
    auto target = open_target(flags.target, "info");
    if (!target) {
        return target.error();
    }
    std::vector<std::string> arguments{"--connect", wire::to_string(target->server)};
    arguments.insert(arguments.end(), {"--classify", flags.classify});
    if (!flags.lod.empty()) {
        arguments.insert(arguments.end(), {"--lod", flags.lod});
    }
    arguments.insert(arguments.end(), {"--culling", flags.culling.kind, "--culling-threshold",
                                       std::to_string(flags.culling.threshold)});
    arguments.insert(arguments.end(), {"--target-rate", std::to_string(flags.target_rate)});
    if (!flags.tf_file.empty()) {
        arguments.insert(arguments.end(), {"--tf", flags.tf_file});
    }
    auto window = Process::start("shearwater-client", arguments, target->secret);
    if (!window) {
        return window.error();
    }
    bool server_gone = false;
    std::optional<int> status;
    std::optional<daemon::Runtime> runtime;
    runtime.emplace(program, target->secret, [&](const wire::NetEvent&) {
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
    auto flags = std::make_shared<Flags>();
    app.add_option("--tf", flags->tf_file, "transfer function to begin with, a TOML file");
    add_classify(app, flags->classify);
    add_lod(app, flags->lod);
    flags->culling.add_to(app);
    app.add_option("--target-rate", flags->target_rate,
                   "frames a second to hold while the view moves, by lesser quality where need be")
        ->check(CLI::Range(1.0, 60.0))
        ->capture_default_str();
    flags->target.add_to(app);
    return [flags] {
        const auto status = view(*flags);
        return status ? *status : refuse(program, status.error());
    };
}

}  // namespace shearwater::deploy
