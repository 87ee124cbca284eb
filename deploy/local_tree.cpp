#include "deploy/local_tree.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <thread>

namespace shearwater::deploy {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

struct Pipe {
    int read = -1;
    int write = -1;

    Pipe() {
        std::array<int, 2> ends{-1, -1};
        if (pipe2(ends.data(), O_CLOEXEC) == 0) {
            read = ends[0];
            write = ends[1];
        }
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe() {
        close_write();
        if (read >= 0) {
            close(read);
        }
    }
    void close_write() {
        if (write >= 0) {
            close(std::exchange(write, -1));
        }
    }
};

// The first line that comes, or nothing when the pipe ends before one.
std::optional<std::string> first_line(int descriptor) {
    std::string line;
    while (line.size() < 4096) {
        char c = 0;
        const ssize_t got = read(descriptor, &c, 1);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0) {
            return std::nullopt;
        }
        if (c == '\n') {
            return line;
        }
        line += c;
    }
    return std::nullopt;
}

std::string_view program_of(tree::Role role) {
    return role == tree::Role::renderer ? "shearwater-renderer" : "shearwater-compositor";
}

// Renderers are seldom busy alike: where one has most of a picture to draw, as when others are hidden behind
// it, it may use every processor. Of very many only some do. Threads that are asked for are shared out.
int threads_each(int wanted, int renderers) {
    constexpr int most_a_processor = 4;
    if (wanted > 0) {
        return std::max(1, wanted / std::max(1, renderers));
    }
    const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    return std::clamp(most_a_processor * processors / std::max(1, renderers), 1, processors);
}

}  // namespace

base::Result<LocalTree> LocalTree::start(const Options& options, const link::Secret& secret) {
    const auto topology = options.tree.topology();
    if (!topology) {
        return topology.error();
    }
    if (topology->launcher != tree::Launcher::local && topology->launcher != tree::Launcher::manual) {
        return base::error(
            base::Code::unsupported, "start a tree",
            "this launcher is not there yet: use \"local\", or \"manual\" and start the daemons yourself");
    }
    std::vector<std::string> arguments = options.cube.arguments();
    const std::vector<std::string> shape = options.tree.arguments();
    const std::vector<std::string> serving = options.serve.arguments();
    arguments.insert(arguments.end(), shape.begin(), shape.end());
    arguments.insert(arguments.end(), serving.begin(), serving.end());
    arguments.insert(arguments.end(),
                     {"--log", options.log_level, "--threads", std::to_string(std::max(0, options.threads))});
    Pipe pipe;
    auto server = Process::start("shearwater-server", arguments, secret, pipe.write);
    if (!server) {
        return server.error();
    }
    pipe.close_write();
    const std::string greeting = "listening on ";
    const auto line = first_line(pipe.read);
    if (!line || !line->starts_with(greeting)) {
        return base::error(base::Code::refused, "", "the server did not start");
    }
    const auto address = wire::parse_address(line->substr(greeting.size()), 0);
    if (!address) {
        return address.error();
    }
    LocalTree tree(*std::move(server), *address, shape[1], secret);
    if (topology->launcher == tree::Launcher::manual) {
        return tree;
    }
    if (const auto started = tree.start_daemons(*topology, options); !started) {
        return started.error();
    }
    return tree;
}

base::Status LocalTree::start_daemons(const tree::Topology& topology, const Options& options) {
    const std::string threads = std::to_string(threads_each(options.threads, topology.renderers()));
    // A server that listens everywhere is reached by loopback from here.
    wire::Address dial = address_;
    if (dial.host == "0.0.0.0" || dial.host == "::") {
        dial.host = dial.host == "::" ? "::1" : "127.0.0.1";
    }
    address_ = dial;
    for (std::size_t i = 1; i < topology.nodes.size(); ++i) {
        const tree::NodeSpec& node = topology.nodes[i];
        Daemon daemon{.program = std::string(program_of(node.role)),
                      .arguments = {"--server", wire::to_string(dial), "--node", node.name, "--log",
                                    options.log_level, "--threads", threads},
                      .process = {},
                      .restart_at = {},
                      .restarts = 0};
        auto process = Process::start(daemon.program, daemon.arguments, secret_);
        if (!process) {
            return process.error();
        }
        daemon.process = *std::move(process);
        daemons_.push_back(std::move(daemon));
    }
    return {};
}

LocalTree::~LocalTree() {
    for (Daemon& daemon : daemons_) {
        if (daemon.process) {
            daemon.process->ask_to_end();
        }
    }
    if (server_) {
        server_->ask_to_end();
    }
}

std::vector<pid_t> LocalTree::daemon_ids() const {
    std::vector<pid_t> ids;
    for (const Daemon& daemon : daemons_) {
        ids.push_back(daemon.process ? daemon.process->id() : -1);
    }
    return ids;
}

bool LocalTree::keep_alive() {
    for (Daemon& daemon : daemons_) {
        if (daemon.process && daemon.process->ended()) {
            daemon.process.reset();
            daemon.restart_at =
                Clock::now() + std::min<std::chrono::milliseconds>(5s, 200ms * (1 << daemon.restarts));
            daemon.restarts = std::min(daemon.restarts + 1, 5);
        }
        if (!daemon.process && Clock::now() >= daemon.restart_at) {
            if (auto process = Process::start(daemon.program, daemon.arguments, secret_)) {
                daemon.process = *std::move(process);
            }
        }
    }
    return server_ && !server_->ended();
}

}  // namespace shearwater::deploy
