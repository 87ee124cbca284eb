#pragma once
// Which cells of a few planes of voxels may be seen.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "renderer/shear/opacity_table.h"

namespace shearwater::shear {

// Nodes of a plane, [first, end) along its rows and across them.
struct PlaneNodes {
    std::int64_t fast_first = std::numeric_limits<std::int64_t>::max(), fast_end = 0;
    std::int64_t slow_first = std::numeric_limits<std::int64_t>::max(), slow_end = 0;

    void add(const PlaneNodes& more) {
        fast_first = std::min(fast_first, more.fast_first);
        fast_end = std::max(fast_end, more.fast_end);
        slow_first = std::min(slow_first, more.slow_first);
        slow_end = std::max(slow_end, more.slow_end);
    }
};

// Of the cells of a plane, [first, end) along its rows and across them, counted from its first node.
struct PlaneCells {
    std::uint8_t fast_first = 0, fast_end = 0, slow_first = 0, slow_end = 0;

    bool operator==(const PlaneCells&) const = default;
    bool empty() const { return fast_first >= fast_end || slow_first >= slow_end; }
};

// So many planes of so many rows of so many voxels, one right behind the other. voxel_padding bytes beyond
// may be read, to no effect.
template <class Code>
struct PlaneCodes {
    const Code* voxels;
    std::int64_t across, down, count;  // nodes along a row and across, at most 256 each, and planes
};

// Where samples may have opacity that lie on a plane, at 2 n for the n-th, or between it and the next, at
// 2 n + 1: anywhere else they lie between codes that are all less than those that have some, or all greater.
template <class Code>
void find_opaque_cells(const PlaneCodes<Code>& planes, const OpacityTable::Codes& opaque,
                       std::span<PlaneCells> cells);

extern template void find_opaque_cells(const PlaneCodes<std::uint8_t>&, const OpacityTable::Codes&,
                                       std::span<PlaneCells>);
extern template void find_opaque_cells(const PlaneCodes<std::uint16_t>&, const OpacityTable::Codes&,
                                       std::span<PlaneCells>);

}  // namespace shearwater::shear
