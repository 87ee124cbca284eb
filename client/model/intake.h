#pragma once
// What a server says, checked and turned into our own values. A Fault ends the link.

#include "client/model/status.h"
#include "protocol/wire/header.h"
#include "protocol/wire/message.h"

namespace shearwater::model {

wire::Parsed<Cube> cube_from(const wire::pb::CubeDescription& description);
// Parents must come from the list itself, without a circle.
wire::Parsed<Tree> tree_from(const wire::pb::TreeState& state);
// The boxes a frame lacks.
wire::Parsed<std::vector<Missing>> missing_from(const wire::pb::Frame& frame);

}  // namespace shearwater::model
