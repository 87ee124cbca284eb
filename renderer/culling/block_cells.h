#pragma once
// A block's cells, each with the least extinction that a ray may meet in it.

#include <array>
#include <cstdint>
#include <vector>

#include "common/volume/box.h"
#include "renderer/culling/cells.h"

namespace shearwater::culling {

struct BlockCells {
    static constexpr int max_edge = 32;

    std::array<int, 3> counts{};      // along each axis
    std::array<int, 3> whole{};       // of them, those that the cube's end does not cut off
    std::vector<std::int16_t> units;  // axis 0 fastest
    std::int16_t least = 0, greatest = 0;

    // Of a box of cells, which has some.
    BlockCells(const Cells& cells, const volume::Box& box);
};

}  // namespace shearwater::culling
