#pragma once
// Pictures by a tree of daemons, ours or a running server's.

#include <string>

#include "common/volume/source.h"
#include "deploy/still.h"
#include "deploy/target.h"

namespace shearwater::deploy {

// Draws `repeat.times` pictures, in their order, and keeps a tree of ours alive meanwhile. Progress
// is Still's. `program` names us to the server.
base::Result<Picture> draw_over_links(const std::string& program, Target& target, const ViewOptions& view,
                                      const view::AnchoredFunction& function, const view::ImageSize& size,
                                      const Repeat& repeat, const volume::Progress& progress);

}  // namespace shearwater::deploy
