#include <spdlog/spdlog.h>

#include <cstdio>
#include <optional>

#include "deploy/commands.h"
#include "deploy/local_tree.h"
#include "deploy/session_secret.h"
#include "deploy/target.h"
#include "protocol/daemon/options.h"
#include "protocol/daemon/runtime.h"

namespace shearwater::deploy {
namespace {

const std::string program = "shearwater serve";

struct Flags {
    options::CubeOptions cube;
    options::TreeOptions tree;
    options::ServeOptions serve;
    daemon::Options common;
};

// Lines to paste: for looking at the cube, and for starting by hand what no launcher starts.
void print_how_to_join(const std::string& cube, const tree::Topology& topology, const wire::Address& server,
                       const std::string& secret_file) {
    const std::string with_secret = secret_file.empty() ? "" : " --secret-file " + secret_file;
    const std::string address = wire::to_string(server);
    std::printf("serving %s; to look at it:\n  shearwater view --connect %s%s\n", cube.c_str(),
                address.c_str(), with_secret.c_str());
    if (topology.launcher == tree::Launcher::manual) {
        std::printf("waiting for the daemons; on their machines:\n");
        for (std::size_t i = 1; i < topology.nodes.size(); ++i) {
            const tree::NodeSpec& node = topology.nodes[i];
            const bool joins_many = node.role == tree::Role::compositor;
            std::printf("  shearwater-%s --server %s --node %s%s%s%s%s\n",
                        std::string(name(node.role)).c_str(), address.c_str(), node.name.c_str(),
                        joins_many ? " --listen 0.0.0.0:0" : "", with_secret.c_str(),
                        node.host.empty() ? "" : "    # on ", node.host.c_str());
        }
    }
    std::fflush(stdout);
}

base::Status serve(const Flags& flags) {
    if (const auto valid = flags.cube.validate(); !valid) {
        return valid;
    }
    const auto topology = flags.tree.topology();
    if (!topology) {
        return topology.error();
    }
    const bool own_file = !flags.common.secret_file.empty();
    const auto chosen = choose_secret(own_file ? flags.common.secret_file : topology->secret_file);
    if (!chosen) {
        return chosen.error();
    }
    auto tree = LocalTree::start({.cube = flags.cube,
                                  .tree = flags.tree,
                                  .serve = flags.serve,
                                  .threads = flags.common.threads,
                                  .log_level = flags.common.log_level},
                                 chosen->secret);
    if (!tree) {
        return tree.error();
    }
    std::string secret_file = own_file ? flags.common.secret_file : topology->secret_file;
    if (chosen->fresh) {
        auto kept = keep_secret(chosen->secret, tree->address().port);
        if (!kept) {
            return kept.error();
        }
        secret_file = *std::move(kept);
    }
    print_how_to_join(flags.cube.path, *topology, tree->address(), secret_file);

    bool server_gone = false;
    std::optional<daemon::Runtime> runtime;
    runtime.emplace(program, chosen->secret, [&](const wire::NetEvent&) {
        if (!tree->keep_alive()) {
            server_gone = true;
            runtime->stop(1);
        }
    });
    runtime->run();
    if (chosen->fresh) {
        std::remove(secret_file.c_str());
    }
    if (server_gone) {
        return base::error(base::Code::io, "serve", "the server process ended unexpectedly");
    }
    return {};
}

}  // namespace

Run add_serve(CLI::App& app) {
    auto flags = std::make_shared<Flags>();
    app.add_option("cube", flags->cube.path, "the FITS file, or synthetic:KIND:SIZE")->required();
    flags->tree.add_to(app);
    flags->cube.add_to(app);
    flags->serve.add_to(app);
    flags->common.add_to(app);
    return [flags] {
        const auto done = serve(*flags);
        return done ? 0 : refuse(program, done.error());
    };
}

}  // namespace shearwater::deploy
