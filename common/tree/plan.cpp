#include "common/tree/plan.h"

#include "common/tree/division.h"

namespace shearwater::tree {

std::vector<Place> Plan::renderers_below(Place place) const {
    std::vector<bool> below(nodes.size(), false);
    std::vector<Place> renderers;
    for (Place node = place; has(node); ++node) {
        const NodeSpec& spec = at(node).spec;
        const auto index = static_cast<std::size_t>(node);
        below[index] = node == place || (spec.parent >= 0 && below[static_cast<std::size_t>(spec.parent)]);
        if (below[index] && spec.role == Role::renderer) {
            renderers.push_back(node);
        }
    }
    return renderers;
}

base::Result<Plan> make_plan(const Topology& topology, const volume::Index3& n) {
    Plan plan;
    for (const NodeSpec& spec : topology.nodes) {
        plan.nodes.push_back({.spec = spec, .box = volume::whole(n), .children = {}});
    }
    for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
        PlannedNode& node = plan.nodes[i];
        node.children = topology.children_of(static_cast<int>(i));
        if (node.children.empty()) {
            continue;
        }
        std::vector<double> weights;
        for (const Place child : node.children) {
            weights.push_back(plan.at(child).spec.weight);
        }
        auto boxes = divide(node.box, weights);
        if (!boxes) {
            return boxes.error();
        }
        for (std::size_t c = 0; c < node.children.size(); ++c) {
            plan.nodes[static_cast<std::size_t>(node.children[c])].box = (*boxes)[c];
        }
    }
    return plan;
}

}  // namespace shearwater::tree
