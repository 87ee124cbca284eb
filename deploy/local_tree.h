#pragma once
// A tree of real daemons on this machine: started, watched, restarted when one dies, ended with us.

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/options/cube_options.h"
#include "common/options/serve_options.h"
#include "common/options/tree_options.h"
#include "common/tree/topology.h"
#include "protocol/link/secret.h"
#include "protocol/wire/events.h"

namespace shearwater::deploy {

// A child process that is killed when it goes out of scope, and by the kernel should we die.
class Process {
  public:
    // Starts `program` from the folder of this executable, with the secret in its environment. What it
    // writes to standard output goes to `out`, or to ours when that is -1.
    static base::Result<Process> start(const std::string& program, const std::vector<std::string>& arguments,
                                       const link::Secret& secret, int out = -1);
    Process(Process&& other) noexcept;
    Process& operator=(Process&& other) noexcept;
    ~Process();

    // The exit status, or 128 + the signal that ended it; nothing while it runs.
    std::optional<int> ended();
    void ask_to_end();
    pid_t id() const { return id_; }

  private:
    explicit Process(pid_t id) : id_(id) {}
    pid_t id_ = -1;
};

class LocalTree {
  public:
    struct Options {
        options::CubeOptions cube;
        options::TreeOptions tree;
        options::ServeOptions serve = {};
        int threads = 0;  // of all renderers together; 0: each may use every processor
        std::string log_level = "warn";
    };

    // Starts the server, waits until it listens, starts the daemons (not where the topology's launcher is
    // "manual"). The server says itself, on standard error, why it cannot start: the error's operation is
    // then empty.
    static base::Result<LocalTree> start(const Options& options, const link::Secret& secret);

    LocalTree(LocalTree&&) = default;
    ~LocalTree();

    const wire::Address& address() const { return address_; }
    const std::string& shape() const { return shape_; }  // "2,3", or the topology file's name

    // The daemons' process ids in the order of the topology's nodes, the server left out; -1: not running.
    std::vector<pid_t> daemon_ids() const;
    pid_t server_id() const { return server_ ? server_->id() : -1; }

    // Starts again what has died, not too often. False when the server is gone.
    bool keep_alive();

  private:
    struct Daemon {
        std::string program;
        std::vector<std::string> arguments;
        std::optional<Process> process;
        std::chrono::steady_clock::time_point restart_at;
        int restarts = 0;
    };

    LocalTree(Process server, wire::Address address, std::string shape, link::Secret secret)
        : server_(std::move(server)),
          address_(std::move(address)),
          shape_(std::move(shape)),
          secret_(std::move(secret)) {}
    base::Status start_daemons(const tree::Topology& topology, const Options& options);

    std::optional<Process> server_;
    wire::Address address_;
    std::string shape_;
    link::Secret secret_;
    std::vector<Daemon> daemons_;
};

}  // namespace shearwater::deploy
