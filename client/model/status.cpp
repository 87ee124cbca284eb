#include "client/model/status.h"

#include <algorithm>

#include "protocol/wire/words.h"

namespace shearwater::model {

namespace {

bool is_renderer(const Node& node) {
    return node.role == wire::pb::ROLE_RENDERER;
}

}  // namespace

double Tree::loaded() const {
    double sum = 0;
    for (const Node& node : nodes) {
        sum += is_renderer(node) ? wire::loaded_share(node.phase, node.fraction) : 0;
    }
    return renderers() > 0 ? sum / renderers() : 0;
}

std::string Status::first_look() const {
    if (!frame || !frame->sketch) {
        return {};
    }
    return "first look, " + std::to_string(static_cast<int>(100 * tree.loaded())) + " % loaded";
}

int Tree::in_phase(wire::pb::Phase phase) const {
    return static_cast<int>(
        std::count_if(nodes.begin(), nodes.end(), [&](const Node& node) { return node.phase == phase; }));
}

int Tree::renderers() const {
    return static_cast<int>(std::count_if(nodes.begin(), nodes.end(), is_renderer));
}

}  // namespace shearwater::model
