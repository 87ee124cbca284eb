#include "common/options/tree_options.h"

#include <CLI/CLI.hpp>

#include "common/base/text_file.h"

namespace shearwater::options {

void TreeOptions::add_to(CLI::App& app) {
    const std::string group = "Tree";
    auto* full = app.add_option("--tree", tree, "branching and levels: B^(LEVELS-1) renderers")
                     ->delimiter(',')
                     ->expected(2)
                     ->allow_extra_args(false)
                     ->type_name("B,LEVELS")
                     ->default_str("2,2")
                     ->group(group);
    app.add_option("--topology", topology_file, "TOML file that describes the tree")
        ->excludes(full)
        ->group(group);
    app.add_option("--listen", listen, "ADDR:PORT of the server; else loopback and a free port")
        ->group(group);
}

base::Result<tree::Topology> TreeOptions::topology() const {
    base::Result<tree::Topology> made = tree::Topology{};
    if (topology_file.empty()) {
        made = tree::full_tree(tree[0], tree[1]);
    } else {
        constexpr std::size_t most_bytes = 4 << 20;
        const auto text = base::read_text_file(topology_file, most_bytes);
        if (!text) {
            return text.error();
        }
        made = tree::topology_from_toml(*text, topology_file);
    }
    if (made) {
        if (!listen.empty()) {
            made->listen = listen;
        } else if (made->listen.empty()) {
            made->listen = "127.0.0.1:0";
        }
    }
    return made;
}

std::vector<std::string> TreeOptions::arguments() const {
    std::vector<std::string> words;
    if (!topology_file.empty()) {
        words = {"--topology", topology_file};
    } else {
        words = {"--tree", std::to_string(tree[0]) + "," + std::to_string(tree[1])};
    }
    if (!listen.empty()) {
        words.insert(words.end(), {"--listen", listen});
    }
    return words;
}

}  // namespace shearwater::options
