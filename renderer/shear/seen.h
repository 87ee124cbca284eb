#pragma once
// What is left of a volume's contents where only some blocks are seen.

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/workers.h"
#include "common/culling/block_grid.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/classification.h"

namespace shearwater::shear {

// Whether a visible block has a part of a box of voxels.
bool sees_any(const volume::Box& box, const culling::VisibleBlocks& visible);

// Of a level's micro-bricks: those in no visible block have no opacity.
std::vector<Content> seen_contents(const CodeVolume& nodes, int level, std::span<const Content> contents,
                                   const culling::VisibleBlocks& visible, base::Workers& workers);

// How many of a volume's bricks are opaque and in no visible block.
std::uint64_t hidden_bricks(const BrickVolume& volume, std::span<const std::uint8_t> opaque,
                            const culling::VisibleBlocks& visible);

}  // namespace shearwater::shear
