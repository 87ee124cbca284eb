#include "client/model/intake.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "protocol/wire/convert.h"
#include "protocol/wire/convert_world.h"

namespace shearwater::model {

namespace {

namespace pb = wire::pb;

constexpr int max_nodes = 65536;

wire::Fault invalid(std::string text) {
    return {pb::REASON_INVALID, std::move(text)};
}

wire::Parsed<Node> node_from(const pb::Node& from) {
    const auto box = wire::box_from(from.box());
    if (!box) {
        return box.error();
    }
    if (!pb::Phase_IsValid(from.phase()) || !pb::Role_IsValid(from.role())) {
        return invalid("tree: a node's phase or role is unknown");
    }
    Node node;
    node.place = from.place();
    node.role = from.role();
    node.name = base::printable(from.name(), 64);
    node.box = *box;
    node.phase = from.phase();
    node.fraction = std::isfinite(from.fraction()) ? std::clamp(from.fraction(), 0.0, 1.0) : 0;
    node.memory_bytes = from.memory_bytes();
    node.error = base::printable(from.error());
    return node;
}

// Puts `place` and all below it behind what is there. Each place is listed under one parent only and is
// taken out of `children` on the way, so this ends.
void append_subtree(std::vector<Node>& out, std::map<std::int64_t, std::vector<Node>>& children,
                    std::int64_t parent) {
    struct Step {
        Node node;
        int depth;
    };
    std::vector<Step> open;
    const auto push = [&](std::int64_t of, int depth) {
        auto below = children.extract(of);
        if (!below.empty()) {
            for (auto node = below.mapped().rbegin(); node != below.mapped().rend(); ++node) {
                open.push_back({std::move(*node), depth});
            }
        }
    };
    push(parent, 0);
    while (!open.empty()) {
        Step step = std::move(open.back());
        open.pop_back();
        step.node.depth = step.depth;
        out.push_back(std::move(step.node));
        push(out.back().place, step.depth + 1);
    }
}

}  // namespace

wire::Parsed<Cube> cube_from(const pb::CubeDescription& description) {
    const auto lattice = wire::lattice_from(description.lattice());
    if (!lattice) {
        return lattice.error();
    }
    const auto mapping = wire::mapping_from(description.mapping());
    if (!mapping) {
        return mapping.error();
    }
    Cube cube{.name = base::printable(description.name()),
              .object = base::printable(description.object()),
              .unit = base::printable(description.unit(), 40),
              .lattice = *lattice,
              .mapping = *mapping,
              .provisional = description.provisional(),
              .values = nullptr};
    auto world = wire::axes_from(description.axes());
    if (!world) {
        return world.error();
    }
    cube.world = std::make_shared<const wcs::Axes>(*std::move(world));
    if (description.has_values()) {
        auto values = wire::summary_from(description.values());
        if (!values) {
            return values.error();
        }
        cube.values = std::make_shared<const volume::Summary>(*std::move(values));
        cube.provisional_values = description.values().provisional();
    }
    return cube;
}

wire::Parsed<Tree> tree_from(const pb::TreeState& state) {
    if (state.nodes_size() > max_nodes) {
        return invalid("tree: too many nodes");
    }
    std::map<std::int64_t, std::vector<Node>> children;
    for (const pb::Node& from : state.nodes()) {
        auto node = node_from(from);
        if (!node) {
            return node.error();
        }
        children[from.parent()].push_back(std::move(*node));
    }
    Tree tree;
    tree.ready = state.ready();
    append_subtree(tree.nodes, children, -1);
    if (tree.nodes.size() != static_cast<std::size_t>(state.nodes_size())) {
        return invalid("tree: a node's parent is not in it");
    }
    return tree;
}

wire::Parsed<std::vector<Missing>> missing_from(const pb::Frame& frame) {
    std::vector<Missing> missing;
    for (const pb::Missing& part : frame.missing()) {
        const auto box = wire::box_from(part.box());
        if (!box) {
            return box.error();
        }
        missing.push_back({part.place(), *box});
    }
    return missing;
}

}  // namespace shearwater::model
