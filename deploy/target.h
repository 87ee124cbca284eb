#pragma once
// What a picture or a window is of: a cube on a tree of our own, here or on another machine, or whatever a
// running server serves.

#include <optional>
#include <string>

#include "common/options/cli_fwd.h"
#include "common/options/cube_options.h"
#include "common/options/tree_options.h"
#include "deploy/local_tree.h"
#include "deploy/remote.h"

namespace shearwater::deploy {

struct TargetOptions {
    options::CubeOptions cube;
    options::TreeOptions tree;
    std::string connect;
    std::string secret_file;
    RemoteOptions remote;
    int threads = 0;

    void add_to(CLI::App& app);
    // One of cube and server, and what no option parser sees of the cube's options.
    base::Status validate() const;
};

struct Target {
    wire::Route server;
    link::Secret secret;
    std::optional<LocalTree> tree;  // where it is our own
};

// Starts the tree, or finds the server's address. Errors as LocalTree::start has them.
base::Result<Target> open_target(const TargetOptions& options, const std::string& log_level);

// The exit status for an error, which is told on standard error unless the server has done so.
int refuse(const std::string& program, const base::Error& error);

}  // namespace shearwater::deploy
