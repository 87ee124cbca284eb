#pragma once
// The schema's enumerations in words for people, and what they mean for a progress bar.

#include <string_view>

#include "protocol/wire/shearwater.pb.h"

namespace shearwater::wire {

std::string_view text_of(pb::Phase phase);  // "vacant", "counting", "ready", ...
std::string_view text_of(pb::Role role);    // "client", "renderer", ...

// The share of a renderer's two passes over its voxels that is done: counting is the first half, loading
// the second. In [0, 1] whatever the peer says of its fraction.
double loaded_share(pb::Phase phase, double fraction);

}  // namespace shearwater::wire
