#include <optional>

#include "deploy/commands.h"
#include "deploy/local_tree.h"
#include "deploy/session_secret.h"
#include "protocol/daemon/runtime.h"

namespace shearwater::deploy {
namespace {

const std::string program = "shearwater view";

struct Flags {
    options::CubeOptions cube;
    options::TreeOptions tree;
    std::string connect;
    std::string secret_file;
    std::string tf_file;
    int threads = 0;
};

// Starts the window and waits until it closes; a local tree is kept alive meanwhile.
base::Result<int> show(const Flags& flags, const wire::Address& server, const link::Secret& secret,
                       LocalTree* tree) {
    std::vector<std::string> arguments{"--connect", wire::to_string(server)};
    if (!flags.tf_file.empty()) {
        arguments.insert(arguments.end(), {"--tf", flags.tf_file});
    }
    auto window = Process::start("shearwater-client", arguments, secret);
    if (!window) {
        return window.error();
    }
    bool server_gone = false;
    std::optional<int> status;
    std::optional<daemon::Runtime> runtime;
    runtime.emplace(program, secret, [&](const wire::NetEvent&) {
        status = window->ended();
        if (tree != nullptr && !tree->keep_alive()) {
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

base::Result<int> view(const Flags& flags) {
    if (const auto valid = flags.cube.validate(); !valid) {
        return valid.error();
    }
    if (flags.cube.path.empty() == flags.connect.empty()) {
        return base::error(base::Code::invalid_argument, "view", "name either a cube or --connect HOST:PORT");
    }
    const auto chosen = choose_secret(flags.secret_file);
    if (!chosen) {
        return chosen.error();
    }
    if (!flags.connect.empty()) {
        const auto server = wire::parse_address(flags.connect, 0);
        if (!server) {
            return server.error();
        }
        return show(flags, *server, chosen->secret, nullptr);
    }
    auto tree =
        LocalTree::start({.cube = flags.cube, .tree = flags.tree, .threads = flags.threads}, chosen->secret);
    if (!tree) {
        return tree.error();
    }
    return show(flags, tree->address(), chosen->secret, &*tree);
}

}  // namespace

Run add_view(CLI::App& app) {
    auto flags = std::make_shared<Flags>();
    app.add_option("cube", flags->cube.path, "the FITS file");
    app.add_option("--connect", flags->connect, "HOST:PORT of a running server, instead of a cube");
    app.add_option("--secret-file", flags->secret_file, "file of mode 0600 with the server's secret");
    app.add_option("--tf", flags->tf_file, "transfer function to begin with, a TOML file");
    app.add_option("--threads", flags->threads, "threads that compute; 0: one a processor")
        ->check(CLI::Range(0, 1024));
    flags->tree.add_to(app);
    flags->cube.add_to(app);
    return [flags] {
        const auto status = view(*flags);
        if (status) {
            return *status;
        }
        return status.error().operation.empty() ? LocalTree::refused
                                                : daemon::refuse(program, status.error());
    };
}

}  // namespace shearwater::deploy
