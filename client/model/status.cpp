#include "client/model/status.h"

#include <algorithm>

namespace shearwater::model {

namespace {

// How far a renderer is on its way: counting is the first half, loading the second.
double loaded_share(const Node& node) {
    switch (node.phase) {
        case wire::pb::PHASE_COUNTING:
            return node.fraction / 2;
        case wire::pb::PHASE_WAITING:
            return 0.5;
        case wire::pb::PHASE_LOADING:
            return 0.5 + node.fraction / 2;
        case wire::pb::PHASE_READY:
            return 1;
        default:
            return 0;
    }
}

bool is_renderer(const Node& node) {
    return node.role == wire::pb::ROLE_RENDERER;
}

}  // namespace

double Tree::loaded() const {
    double sum = 0;
    for (const Node& node : nodes) {
        sum += is_renderer(node) ? loaded_share(node) : 0;
    }
    return renderers() > 0 ? sum / renderers() : 0;
}

int Tree::in_phase(wire::pb::Phase phase) const {
    return static_cast<int>(
        std::count_if(nodes.begin(), nodes.end(), [&](const Node& node) { return node.phase == phase; }));
}

int Tree::renderers() const {
    return static_cast<int>(std::count_if(nodes.begin(), nodes.end(), is_renderer));
}

}  // namespace shearwater::model
