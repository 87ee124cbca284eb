#include <algorithm>
#include <cmath>
#include <optional>

#include "common/document/reader.h"
#include "common/tree/topology.h"

namespace shearwater::tree {
namespace {

using base::Code;

struct Draft {
    NodeSpec spec;
    std::string parent;
    bool has_weight = false;
};

base::Error fault(std::string_view source, const std::string& detail) {
    return base::error(Code::invalid_argument, "topology " + std::string(source), detail);
}

// The first key of a table that is not among those it may have.
std::optional<std::string> unknown_key(const toml::table& table,
                                       std::initializer_list<std::string_view> known) {
    for (const auto& [key, value] : table) {
        if (std::ranges::find(known, key.str()) == known.end()) {
            return std::string(key.str());
        }
    }
    return std::nullopt;
}

std::optional<Role> role_named(std::string_view text) {
    for (const Role role : {Role::server, Role::compositor, Role::renderer}) {
        if (name(role) == text) {
            return role;
        }
    }
    return std::nullopt;
}

std::optional<Launcher> launcher_named(std::string_view text) {
    if (text == "local") return Launcher::local;
    if (text == "ssh") return Launcher::ssh;
    if (text == "slurm") return Launcher::slurm;
    if (text == "manual") return Launcher::manual;
    return std::nullopt;
}

base::Result<Draft> read_node(const toml::table& table, std::string_view source) {
    if (const auto key = unknown_key(table, {"name", "role", "parent", "host", "weight"})) {
        return fault(source, "a node has no key '" + *key + "'");
    }
    Draft draft;
    draft.spec.name = table["name"].value_or(std::string{});
    if (draft.spec.name.empty()) {
        return fault(source, "every node needs a name");
    }
    const auto role = role_named(table["role"].value_or(std::string{}));
    if (!role) {
        return fault(source, "node '" + draft.spec.name + "' needs a role: server, compositor or renderer");
    }
    draft.spec.role = *role;
    draft.parent = table["parent"].value_or(std::string{});
    draft.spec.host = table["host"].value_or(std::string{});
    if (table.contains("weight")) {
        draft.has_weight = true;
        draft.spec.weight = table["weight"].value_or(0.0);
        if (!(draft.spec.weight > 0) || !std::isfinite(draft.spec.weight)) {
            return fault(source, "the weight of node '" + draft.spec.name + "' is not a number above 0");
        }
    }
    return draft;
}

// A compositor that says nothing weighs what its children do. Parents stand before children.
void sum_weights(std::vector<NodeSpec>& nodes, const std::vector<bool>& has_weight) {
    std::vector<double> below(nodes.size(), 0);
    for (std::size_t i = nodes.size(); i-- > 1;) {
        if (nodes[i].role == Role::compositor && !has_weight[i]) {
            nodes[i].weight = below[i];
        }
        below[static_cast<std::size_t>(nodes[i].parent)] += nodes[i].weight;
    }
}

// Puts the nodes in order, the server first, each parent before its children; nodes that hang on
// nothing or on each other are a fault.
base::Result<std::vector<NodeSpec>> arrange(std::vector<Draft> drafts, std::string_view source) {
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (drafts[i].spec.name == drafts[j].spec.name) {
                return fault(source, "two nodes are named '" + drafts[i].spec.name + "'");
            }
        }
    }
    const auto servers =
        std::ranges::count_if(drafts, [](const Draft& d) { return d.spec.role == Role::server; });
    if (servers > 1) {
        return fault(source, "there is more than one server");
    }
    if (servers == 0) {
        drafts.push_back({.spec = {.name = "server", .role = Role::server}, .parent = {}});
    }
    std::vector<NodeSpec> nodes;
    std::vector<bool> has_weight;
    std::vector<bool> placed(drafts.size(), false);
    const auto place = [&](std::size_t i, int parent) {
        placed[i] = true;
        drafts[i].spec.parent = parent;
        nodes.push_back(drafts[i].spec);
        has_weight.push_back(drafts[i].has_weight);
    };
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        if (drafts[i].spec.role == Role::server) {
            place(i, -1);
        }
    }
    for (std::size_t parent = 0; parent < nodes.size(); ++parent) {
        const NodeSpec owner = nodes[parent];
        for (std::size_t i = 0; i < drafts.size(); ++i) {
            const std::string& wanted = drafts[i].parent;
            if (!placed[i] && (wanted == owner.name || (wanted.empty() && owner.role == Role::server))) {
                if (owner.role == Role::renderer) {
                    return fault(source, "node '" + drafts[i].spec.name + "' hangs on a renderer");
                }
                place(i, static_cast<int>(parent));
            }
        }
    }
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        if (!placed[i]) {
            return fault(source, "node '" + drafts[i].spec.name + "' hangs on '" + drafts[i].parent +
                                     "', which does not lead to the server");
        }
    }
    sum_weights(nodes, has_weight);
    return nodes;
}

base::Status check_arity(const Topology& topology, std::string_view source) {
    if (topology.nodes.size() > Topology::max_nodes) {
        return fault(source, "more than " + std::to_string(Topology::max_nodes) + " nodes");
    }
    for (std::size_t i = 0; i < topology.nodes.size(); ++i) {
        const auto children = topology.children_of(static_cast<int>(i)).size();
        if (topology.nodes[i].role != Role::renderer && children == 0) {
            return fault(source, "node '" + topology.nodes[i].name + "' has no children");
        }
        if (children > Topology::max_children) {
            return fault(source, "node '" + topology.nodes[i].name + "' has more than 64 children");
        }
    }
    return {};
}

base::Result<Topology> read_topology(const toml::table& root, std::string_view source) {
    if (const auto key = unknown_key(root, {"tree", "node", "server", "security", "placement"})) {
        return fault(source, "unknown key '" + *key + "'");
    }
    Topology topology;
    if (const toml::table* tree = root["tree"].as_table()) {
        if (root.contains("node")) {
            return fault(source, "either [tree] or [[node]], not both");
        }
        constexpr std::int64_t most = Topology::max_nodes;
        const auto number = [&](const char* key) {
            return static_cast<int>(
                std::clamp((*tree)[key].value_or(std::int64_t{0}), std::int64_t{-1}, most));
        };
        auto full = full_tree(number("branching"), number("levels"));
        if (!full) {
            return fault(source, full.error().detail);
        }
        topology = *std::move(full);
    } else if (const toml::array* list = root["node"].as_array()) {
        std::vector<Draft> drafts;
        for (const toml::node& entry : *list) {
            const toml::table* table = entry.as_table();
            if (table == nullptr || drafts.size() > Topology::max_nodes) {
                return fault(source, "[[node]] is a list of at most 4096 tables");
            }
            auto draft = read_node(*table, source);
            if (!draft) {
                return draft.error();
            }
            drafts.push_back(*std::move(draft));
        }
        auto nodes = arrange(std::move(drafts), source);
        if (!nodes) {
            return nodes.error();
        }
        topology.nodes = *std::move(nodes);
    } else {
        return fault(source, "neither [tree] nor [[node]]");
    }
    const std::pair<const char*, const char*> sections[] = {
        {"server", "listen"}, {"security", "secret_file"}, {"placement", "launcher"}};
    for (const auto& [section, only] : sections) {
        const toml::table* const table = root[section].as_table();
        if (root.contains(section) && table == nullptr) {
            return fault(source, "[" + std::string(section) + "] is a table");
        }
        if (const auto key = table != nullptr ? unknown_key(*table, {only}) : std::nullopt) {
            return fault(source, "[" + std::string(section) + "] has no key '" + *key + "'");
        }
    }
    topology.listen = root["server"]["listen"].value_or(std::string{});
    topology.secret_file = root["security"]["secret_file"].value_or(std::string{});
    const std::string launcher = root["placement"]["launcher"].value_or(std::string{"local"});
    if (const auto known = launcher_named(launcher)) {
        topology.launcher = *known;
    } else {
        return fault(source, "unknown launcher '" + launcher + "'");
    }
    if (const auto fine = check_arity(topology, source); !fine) {
        return fine.error();
    }
    return topology;
}

}  // namespace

base::Result<Topology> topology_from_toml(std::string_view text, std::string_view source) {
    constexpr std::size_t longest_text = std::size_t{4} << 20;
    const auto root = document::parse(text, "topology " + std::string(source), longest_text);
    if (!root) {
        return root.error();
    }
    return read_topology(*root, source);
}

}  // namespace shearwater::tree
