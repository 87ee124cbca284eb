#include "deploy/target.h"

#include <CLI/CLI.hpp>

#include "deploy/session_secret.h"
#include "protocol/daemon/runtime.h"

namespace shearwater::deploy {

void TargetOptions::add_to(CLI::App& app) {
    app.add_option("cube", cube.path,
                   "the FITS file, USER@HOST:PATH of one elsewhere, or synthetic:KIND:SIZE");
    app.add_option("--connect", connect, "HOST:PORT of a running server, instead of a cube");
    app.add_option("--secret-file", secret_file, "file of mode 0600 with the server's secret");
    app.add_option("--threads", threads, "threads that compute; 0: one a processor")
        ->check(CLI::Range(0, 1024));
    remote.add_to(app);
    tree.add_to(app);
    cube.add_to(app);
}

base::Status TargetOptions::validate() const {
    if (cube.path.empty() == connect.empty()) {
        return base::error(base::Code::invalid_argument, "", "name either a cube or --connect HOST:PORT");
    }
    return cube.validate();
}

base::Result<Target> open_target(const TargetOptions& options, const std::string& log_level) {
    const auto chosen = choose_secret(options.secret_file);
    if (!chosen) {
        return chosen.error();
    }
    if (!options.connect.empty()) {
        const auto server = wire::parse_address(options.connect, 0);
        if (!server) {
            return server.error();
        }
        return Target{.server = *server, .secret = chosen->secret, .tree = {}};
    }
    if (remote_cube(options.cube.path)) {
        return Target{
            .server = wire::Route(serving_command(options, "warn")), .secret = chosen->secret, .tree = {}};
    }
    auto tree = LocalTree::start(
        {.cube = options.cube, .tree = options.tree, .threads = options.threads, .log_level = log_level},
        chosen->secret);
    if (!tree) {
        return tree.error();
    }
    Target target{.server = tree->address(), .secret = chosen->secret, .tree = {}};
    target.tree.emplace(*std::move(tree));
    return target;
}

int refuse(const std::string& program, const base::Error& error) {
    constexpr int users_mistake = 2;
    return error.code == base::Code::refused && error.operation.empty() ? users_mistake
                                                                        : daemon::refuse(program, error);
}

}  // namespace shearwater::deploy
