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

// Fills in the ranges of a grid over `own`, a box inside that of the codes, and, as `reaches`, what they
// would be with one node more on every side, where there is one; false if stopped before.
template <class Code>
bool survey(const CodesOfBox<Code>& codes, const volume::Box& own, CodeGrid& micro_bricks,
            std::span<CodeRange> reaches, base::Workers& workers, const std::stop_token& stop);

extern template bool survey(const CodesOfBox<std::uint8_t>&, const volume::Box&, CodeGrid&,
                            std::span<CodeRange>, base::Workers&, const std::stop_token&);
extern template bool survey(const CodesOfBox<std::uint16_t>&, const volume::Box&, CodeGrid&,
                            std::span<CodeRange>, base::Workers&, const std::stop_token&);

// What a coarser grid over the same box makes of a finer one's ranges.
void summarise(const CodeGrid& fine, CodeGrid& coarse);

}  // namespace shearwater::shear
