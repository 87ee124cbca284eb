#pragma once
// The shape of a tree before it knows its cube: who is whose child, and where each should run.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"

namespace shearwater::tree {

enum class Role { server, compositor, renderer };
std::string_view name(Role role);

struct NodeSpec {
    std::string name;
    Role role = Role::renderer;
    int parent = -1;    // index of the parent; -1 for the server only
    std::string host;   // where a launcher should start it; empty: anywhere
    double weight = 1;  // its share among its siblings (a compositor's: the sum of its children's)
};

enum class Launcher { local, ssh, slurm, manual };

// nodes[0] is the server; a parent stands before its children. Every compositor has children, at most
// max_children; every renderer is a leaf.
struct Topology {
    static constexpr int max_children = 64;
    static constexpr int max_nodes = 4096;

    std::vector<NodeSpec> nodes;
    std::string listen;       // the server's, "ADDR:PORT"; empty: loopback, a free port
    std::string secret_file;  // empty: none is named
    Launcher launcher = Launcher::local;

    std::vector<int> children_of(int node) const;
    int renderers() const;
};

// The full tree of branching b and n levels: b^(n-1) renderers and 1 + b + ... + b^(n-2) compositors,
// the server being one (DVR 3.1). b in [1, 64], levels at least 2.
base::Result<Topology> full_tree(int branching, int levels);

// The topology file of design section 4. Nodes may come in any order; what is wrong is named.
base::Result<Topology> topology_from_toml(std::string_view text, std::string_view source);

}  // namespace shearwater::tree
