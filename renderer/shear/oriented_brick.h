#pragma once
// A brick as a face's kernel wants it: planes along the principal axis, rows along the slow axis, adjacent
// voxels along the fast one. Where voxels are adjacent along the principal axis it is turned into a scratch.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/shear/brick_volume.h"
#include "renderer/shear/face_plan.h"

namespace shearwater::shear {

// Micro-bricks of one layer across a face: bit 4 * slow + fast.
using MicroPlane = std::uint16_t;

// The micro-bricks of a brick's layers, by an axis order fast, slow, deep.
class MicroMask {
  public:
    MicroMask(std::uint64_t opaque, const FacePlan& plan);
    MicroPlane layer(std::int64_t deep) const;
    // The least and greatest number along the axes fast, slow, deep; the mask is not empty.
    std::array<std::array<std::int64_t, 2>, 3> extent() const;

  private:
    std::uint64_t opaque_;
    std::array<int, 3> shifts_;  // of one step along fast, slow, deep
};

template <class Code>
struct OrientedBrick {
    const Code* voxels;
    std::ptrdiff_t row_stride, plane_stride;
    std::array<std::int64_t, 3> lo, cells;  // along fast, slow, deep
    MicroMask opaque;
    bool blanks;

    // The layer of micro-bricks that the plane at w along the principal axis lies in.
    std::int64_t micro_layer(double w) const {
        const auto plane = static_cast<std::int64_t>(w) - lo[2];
        return std::min(plane, cells[2] - 1) / MicroBricks::edge;
    }
};

// Voxels that a frame needs of a brick, both ends included, along fast, slow, deep, from its first.
using VoxelRanges = std::array<std::array<std::int64_t, 2>, 3>;

// `needed` bounds what of it is turned, where it has to be. The scratch has to outlive what is returned.
template <class Code>
OrientedBrick<Code> orient(const Brick& brick, std::span<const Code> codes, std::uint64_t opaque,
                           const FacePlan& plan, const VoxelRanges& needed, std::vector<Code>& scratch);

}  // namespace shearwater::shear
