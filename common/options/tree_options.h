#pragma once
// The options that say what tree to make and where its server listens.

#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/options/cli_fwd.h"
#include "common/tree/topology.h"

namespace shearwater::options {

struct TreeOptions {
    std::vector<int> tree{2, 2};  // branching, levels
    std::string topology_file;
    std::string listen;  // "ADDR:PORT"

    void add_to(CLI::App& app);

    // --tree 1,1: no daemons at all.
    bool one_process() const { return topology_file.empty() && tree == std::vector<int>{1, 1}; }
    // Of the file, or the full tree. Its `listen` is --listen, else the file's, else loopback and a free
    // port.
    base::Result<tree::Topology> topology() const;
    std::vector<std::string> arguments() const;
};

}  // namespace shearwater::options
