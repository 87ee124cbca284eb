#pragma once
// The opacity functions of some blocks, as rasters over a direction grid: one byte an entry.

#include <cstdint>
#include <vector>

#include "common/volume/box.h"

namespace shearwater::culling {

struct FunctionTable {
    volume::Box blocks;  // of a block grid: from lo to hi, the latter not included
    int side = 0;        // of the direction grid
    // Codes (rates.h): that of block b in direction cell c at [c * block_count() + b], axis 0 fastest.
    std::vector<std::uint8_t> codes;

    std::size_t block_count() const {
        return static_cast<std::size_t>(blocks.cells(0) * blocks.cells(1) * blocks.cells(2));
    }
    bool operator==(const FunctionTable&) const = default;
};

// The same over a grid of `times` as many cells along either angle, whose cells lie in those of the other.
FunctionTable finer(const FunctionTable& table, int times);

}  // namespace shearwater::culling
