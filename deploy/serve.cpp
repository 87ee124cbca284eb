#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>

#include "deploy/commands.h"
#include "deploy/local_tree.h"
#include "deploy/session_secret.h"
#include "deploy/target.h"
#include "protocol/daemon/options.h"
#include "protocol/daemon/runtime.h"
#include "protocol/link/relay.h"

namespace shearwater::deploy {
namespace {

const std::string serve_program = "shearwater serve";

struct ServeFlags {
    options::CubeOptions cube;
    options::TreeOptions tree;
    options::ServeOptions serve;
    daemon::Options common;
    bool stdio = false;
};

// Our standard streams, which are the client's; whatever else is written to them goes to standard error from
// now on, and nothing else reads from them.
struct Streams {
    int in = -1, out = -1;
};
base::Result<Streams> take_streams() {
    const Streams taken{fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3), fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3)};
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (taken.in < 0 || taken.out < 0 || nothing < 0 || dup2(nothing, STDIN_FILENO) < 0 ||
        dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
        return base::error(base::Code::io, "serve --stdio", std::strerror(errno));
    }
    close(nothing);
    return taken;
}

// The client's first line.
base::Result<link::Secret> read_secret(int in) {
    constexpr std::size_t longest = 1024;
    std::string line;
    for (char c = 0; line.size() < longest && read(in, &c, 1) == 1 && c != '\n';) {
        line += c;
    }
    auto secret = link::Secret::from_text(line);
    if (!secret) {
        return base::error(secret.error().code, "serve --stdio", "the first line should be a secret");
    }
    return secret;
}

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

base::Status serve(const ServeFlags& flags) {
    if (const auto valid = flags.cube.validate(); !valid) {
        return valid;
    }
    const auto topology = flags.tree.topology();
    if (!topology) {
        return topology.error();
    }
    Streams streams;
    base::Result<ChosenSecret> chosen = ChosenSecret{link::Secret::random(), false};
    const bool own_file = !flags.common.secret_file.empty();
    if (flags.stdio) {
        const auto taken = take_streams();
        if (!taken) {
            return taken.error();
        }
        streams = *taken;
        const auto told = read_secret(streams.in);
        if (!told) {
            return told.error();
        }
        chosen->secret = *told;
    } else {
        chosen = choose_secret(own_file ? flags.common.secret_file : topology->secret_file);
        if (!chosen) {
            return chosen.error();
        }
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
    std::optional<link::Relay> relay;
    if (flags.stdio) {
        relay.emplace(streams.in, streams.out, tree->address());
    } else {
        print_how_to_join(flags.cube.path, *topology, tree->address(), secret_file);
    }

    bool server_gone = false;
    std::optional<daemon::Runtime> runtime;
    runtime.emplace(serve_program, chosen->secret, [&](const wire::NetEvent&) {
        if (!tree->keep_alive()) {
            server_gone = true;
            runtime->stop(1);
        } else if (relay && relay->ended()) {
            runtime->stop(0);
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
    auto flags = std::make_shared<ServeFlags>();
    app.add_option("cube", flags->cube.path, "the FITS file, or synthetic:KIND:SIZE")->required();
    flags->tree.add_to(app);
    flags->cube.add_to(app);
    flags->serve.add_to(app);
    app.add_flag("--stdio", flags->stdio,
                 "serve one client through the standard streams, whose first line is a secret; ends with it");
    flags->common.add_to(app);
    return [flags] {
        const auto done = serve(*flags);
        return done ? 0 : refuse(serve_program, done.error());
    };
}

}  // namespace shearwater::deploy
