#pragma once
// A transfer function applied to a volume: what an edit changes. Made once for many views.

#include <cstdint>
#include <vector>

#include "common/base/workers.h"
#include "common/view/transfer_function.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/opacity_table.h"

namespace shearwater::shear {

struct Classification {
    OpacityTable table;
    // For each brick a bit per micro-brick, as MicroBricks counts them: whether a sample in it may have
    // opacity.
    std::vector<std::uint64_t> opaque;
};

Classification classify(const BrickVolume& volume, const view::TransferFunction& tf, base::Workers& workers);

}  // namespace shearwater::shear
