#pragma once
// A topology laid over a cube: every node's place, box and children.

#include <string>
#include <vector>

#include "common/tree/topology.h"
#include "common/volume/box.h"

namespace shearwater::tree {

// A node's number in its plan: the server's is 0, a parent's is below its children's.
using Place = int;

struct PlannedNode {
    NodeSpec spec;
    volume::Box box;
    std::vector<Place> children;
};

struct Plan {
    std::vector<PlannedNode> nodes;

    const PlannedNode& at(Place place) const { return nodes[static_cast<std::size_t>(place)]; }
    bool has(Place place) const { return place >= 0 && static_cast<std::size_t>(place) < nodes.size(); }
    // The renderers at or below a node, by rising place.
    std::vector<Place> renderers_below(Place place) const;
};

// Divides whole(n) down the topology. An error names the box whose planes ran out.
base::Result<Plan> make_plan(const Topology& topology, const volume::Index3& n);

}  // namespace shearwater::tree
