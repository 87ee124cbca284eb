#pragma once
// A workload's path drawn by a tree of daemons, as options ask for it.

#include <string>
#include <vector>

#include "deploy/bench/options.h"
#include "deploy/picture.h"

namespace shearwater::bench {

struct PathOnTree {
    Options common;
    std::vector<int> tree;  // branching, levels
    std::int64_t edge;
    std::string workload = "W1";

    // All but the cube's edge.
    void add_to(CLI::App& app);

    struct Drawn {
        int renderers, nodes;  // the server among the nodes
        deploy::Picture picture;
    };
    // Shows its progress.
    base::Result<Drawn> draw() const;
};

}  // namespace shearwater::bench
