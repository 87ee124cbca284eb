#pragma once
// Frames by real daemons on this machine, over a cube that each makes its own part of.

#include "common/options/cube_options.h"
#include "common/options/tree_options.h"
#include "deploy/picture.h"
#include "deploy/script.h"
#include "deploy/target.h"
#include "deploy/view_options.h"

namespace shearwater::bench {

class OnTree {
  public:
    static base::Result<OnTree> start(const options::CubeOptions& cube, int branching, int levels,
                                      int threads);

    // A few pictures unmeasured, one if each is asked for when the last has come, then `frames` along the
    // path that `view` begins: `each` of them, and their medians. The first time, the tree loads before.
    base::Result<deploy::Picture> draw_path(deploy::ViewOptions view, int frames,
                                            const view::TransferFunction& tf,
                                            const volume::Progress& progress, int in_flight = 1);

    // Pictures one after the other, with what changes between them.
    base::Result<deploy::Picture> draw(const deploy::ViewOptions& view, deploy::Script script,
                                       const volume::Progress& progress);

    int renderers() const { return renderers_; }
    int nodes() const { return nodes_; }  // the server among them

  private:
    OnTree(deploy::Target target, int renderers, int nodes)
        : target_(std::move(target)), renderers_(renderers), nodes_(nodes) {}

    deploy::Target target_;
    int renderers_;
    int nodes_;
};

}  // namespace shearwater::bench
