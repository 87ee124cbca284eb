#pragma once
// Frames without daemons: the cube in bricks, and each stage of a picture timed.

#include <memory>

#include "common/base/workers.h"
#include "common/image/image.h"
#include "common/options/cube_options.h"
#include "common/view/camera.h"
#include "common/view/factorisation.h"
#include "common/view/transfer_function.h"
#include "common/volume/source.h"
#include "deploy/bench/timing.h"
#include "deploy/view_options.h"
#include "renderer/culling/culler.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/classification.h"

namespace shearwater::bench {

struct FrameTimes {
    double factorise = 0, cull = 0, render = 0, warp = 0, encode = 0;  // seconds
    std::uint64_t samples = 0;
    int level = 0;  // of detail
    double total() const { return factorise + cull + render + warp + encode; }
};

// Medians over frames, and the whole frames' spread.
struct FrameSummary {
    Spread total;
    double factorise = 0, cull = 0, render = 0, warp = 0, encode = 0;
    double samples = 0;             // a frame, on average
    double samples_per_second = 0;  // of rendering
};
FrameSummary summary(const std::vector<FrameTimes>& frames);

// What leaves out hidden blocks, of the cube that is drawn.
struct Culling {
    culling::Culler& culler;
    culling::Settings settings;
};

class InProcess {
  public:
    // By --range, else by percentile.
    static base::Result<InProcess> load(const options::CubeOptions& cube, int threads,
                                        const volume::Progress& progress);

    const view::Lattice& lattice() const { return lattice_; }
    int threads() const { return workers_->threads(); }
    base::Workers& workers() const { return *workers_; }
    const shear::BrickVolume& bricks() const { return bricks_; }

    // Opacity functions that are missing are computed first, and not counted.
    FrameTimes draw(const view::Camera& camera, const view::ImageSize& size, view::Sampling sampling,
                    const view::TransferFunction& tf, const Culling* culling = nullptr);
    // One frame unmeasured, then `frames` along the path that `view` begins.
    base::Result<std::vector<FrameTimes>> draw_path(deploy::ViewOptions view, int frames,
                                                    const view::TransferFunction& tf,
                                                    const volume::Progress& progress);

  private:
    InProcess(view::Lattice lattice, std::unique_ptr<base::Workers> workers, shear::BrickVolume bricks)
        : lattice_(lattice), workers_(std::move(workers)), bricks_(std::move(bricks)) {}

    view::Lattice lattice_;
    std::unique_ptr<base::Workers> workers_;
    shear::BrickVolume bricks_;
    shear::Classifier classifier_;  // of the bricks
};

}  // namespace shearwater::bench
