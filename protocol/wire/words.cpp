#include "protocol/wire/words.h"

#include <algorithm>
#include <cmath>

namespace shearwater::wire {

std::string_view text_of(pb::Phase phase) {
    switch (phase) {
        case pb::PHASE_VACANT: return "vacant";
        case pb::PHASE_JOINED: return "joined";
        case pb::PHASE_COUNTING: return "counting";
        case pb::PHASE_WAITING: return "waiting";
        case pb::PHASE_LOADING: return "loading";
        case pb::PHASE_READY: return "ready";
        case pb::PHASE_FAILED: return "failed";
        default: return "unknown";
    }
}

std::string_view text_of(pb::Role role) {
    switch (role) {
        case pb::ROLE_CLIENT: return "client";
        case pb::ROLE_RENDERER: return "renderer";
        case pb::ROLE_COMPOSITOR: return "compositor";
        case pb::ROLE_CHILD: return "child";
        default: return "unknown";
    }
}

double loaded_share(pb::Phase phase, double fraction) {
    const double share = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0;
    switch (phase) {
        case pb::PHASE_COUNTING: return share / 2;
        case pb::PHASE_WAITING: return 0.5;
        case pb::PHASE_LOADING: return 0.5 + share / 2;
        case pb::PHASE_READY: return 1;
        default: return 0;
    }
}

}  // namespace shearwater::wire
