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
// The pixels of a frame whose size is the one asked for: memory goes by that size, not by the sender's word.
wire::Parsed<image::Image<image::Rgba8>> picture_from(const wire::Message& message,
                                                      const view::ImageSize& asked);

}  // namespace shearwater::model
