#pragma once
// One leaf's share of a frame: its bricks, sheared and composited into a window per face.

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <vector>

#include "common/base/workers.h"
#include "common/culling/block_grid.h"
#include "common/image/image.h"
#include "common/view/bands.h"
#include "common/view/factorisation.h"
#include "common/view/transfer_function.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/classification.h"

namespace shearwater::shear {

struct RenderStats {
    std::uint64_t samples = 0;  // taken along all rays
    std::uint64_t bricks_total = 0;
    std::uint64_t bricks_empty = 0;     // no opacity under this transfer function
    std::uint64_t bricks_culled = 0;    // hidden behind others, of those that have some
    std::uint64_t bricks_rendered = 0;  // seen by at least one ray
};

// What is drawn of a frame: all its bands up to `bands`, of which the last has the window. That is without
// pixels where the sub-volume projects to nothing.
struct DrawnBands {
    std::size_t bands = 0;
    image::Window window;
};
using OnBands = std::function<void(DrawnBands)>;

struct RenderOptions {
    std::stop_token stop = {};                        // soon after a request what is returned is of no use
    const culling::VisibleBlocks* visible = nullptr;  // what lies in other blocks is left out
};

// Renders a classified volume band by band, in the order of the frame's bands; they are cut from the faces in
// that of the faces. `on_bands` is told of them as soon as they are whole, in their order and one after the
// other, on any of the threads, while the others go on.
RenderStats render_bands(const BrickVolume& volume, const Classification& classification,
                         const view::Factorisation& factorisation, std::span<const view::Band> bands,
                         base::Workers& workers, const OnBands& on_bands, const RenderOptions& options = {});

struct Rendered {
    std::vector<image::Window> windows;
    RenderStats stats;
};

// Renders a classified volume for every face, front to back with early termination. The factorisation's
// lattice is the cube's. Samples are placed by global voxel index, so windows of leaves that share a
// factorisation merge exactly. At most one window a face, none where the box projects to nothing.
Rendered render(const BrickVolume& volume, const Classification& classification,
                const view::Factorisation& factorisation, base::Workers& workers,
                const RenderOptions& options = {});
// Classifies it first.
Rendered render(const BrickVolume& volume, const view::Factorisation& factorisation,
                const view::TransferFunction& tf, base::Workers& workers, const RenderOptions& options = {});

}  // namespace shearwater::shear
