#pragma once
// World coordinates of a cube's axes on the wire.

#include "common/wcs/axis.h"
#include "protocol/wire/header.h"

namespace shearwater::wire {

using WorldAxes = google::protobuf::RepeatedPtrField<pb::WorldAxis>;

// Nothing where no axis is known.
void put(const wcs::Axes& axes, WorldAxes& to);
// None or three, each valid; what they are called is printable.
Parsed<wcs::Axes> axes_from(const WorldAxes& axes);

}  // namespace shearwater::wire
