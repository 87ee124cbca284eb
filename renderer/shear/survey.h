#pragma once
// Which codes occur where.

#include <span>
#include <stop_token>

#include "common/base/workers.h"
#include "renderer/shear/code_volume.h"

namespace shearwater::shear {

// A box's codes, the first of them that of its first voxel, axis 0 adjacent.
template <class Code>
struct CodesOfBox {
    const Code* first;
    volume::Box box;
    std::ptrdiff_t row_stride, plane_stride;
};

// Fills in the ranges of a grid of edge micro_edge over the box, and of its members' octants, none of which
// is known before; false if stopped before.
template <class Code>
bool survey(const CodesOfBox<Code>& codes, CodeGrid& micro_bricks, std::span<Octants> octants,
            base::Workers& workers, const std::stop_token& stop);

extern template bool survey(const CodesOfBox<std::uint8_t>&, CodeGrid&, std::span<Octants>, base::Workers&,
                            const std::stop_token&);
extern template bool survey(const CodesOfBox<std::uint16_t>&, CodeGrid&, std::span<Octants>, base::Workers&,
                            const std::stop_token&);

// What a grid over a box makes of the ranges of one over its nodes of a level: each is added to all cells
// that it reaches.
void summarise(const CodeGrid& nodes, int level, CodeGrid& voxels);

}  // namespace shearwater::shear
