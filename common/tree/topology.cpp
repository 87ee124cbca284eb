#include "common/tree/topology.h"

#include <algorithm>

namespace shearwater::tree {

std::string_view name(Role role) {
    switch (role) {
        case Role::server:
            return "server";
        case Role::compositor:
            return "compositor";
        case Role::renderer:
            return "renderer";
    }
    return "unknown";
}

std::vector<int> Topology::children_of(int node) const {
    std::vector<int> children;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].parent == node) {
            children.push_back(static_cast<int>(i));
        }
    }
    return children;
}

int Topology::renderers() const {
    return static_cast<int>(std::ranges::count(nodes, Role::renderer, &NodeSpec::role));
}

base::Result<Topology> full_tree(int branching, int levels) {
    const std::string operation = "tree " + std::to_string(branching) + "," + std::to_string(levels);
    if (branching < 1 || branching > Topology::max_children || levels < 2) {
        return base::error(base::Code::invalid_argument, operation,
                           "branching is 1 to 64 and there are at least 2 levels");
    }
    Topology topology;
    topology.nodes.push_back({.name = "server", .role = Role::server});
    std::size_t level_begin = 0;
    for (int level = 1; level < levels; ++level) {
        const Role role = level == levels - 1 ? Role::renderer : Role::compositor;
        const std::size_t level_end = topology.nodes.size();
        for (std::size_t parent = level_begin; parent < level_end; ++parent) {
            for (int child = 0; child < branching; ++child) {
                if (topology.nodes.size() >= Topology::max_nodes) {
                    return base::error(base::Code::too_large, operation,
                                       "more than " + std::to_string(Topology::max_nodes) + " nodes");
                }
                topology.nodes.push_back(
                    {.name = std::string(name(role)) + "-" + std::to_string(topology.nodes.size()),
                     .role = role,
                     .parent = static_cast<int>(parent)});
            }
        }
        level_begin = level_end;
    }
    return topology;
}

}  // namespace shearwater::tree
