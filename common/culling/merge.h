#pragma once
// The functions of a whole cube from those of its sub-volumes.

#include <memory>
#include <vector>

#include "common/culling/block_grid.h"
#include "common/culling/direction_grid.h"
#include "common/culling/function_store.h"
#include "common/culling/function_table.h"

namespace shearwater::culling {

struct SubVolume {
    volume::Box box;  // voxels, disjoint from the others'
    std::shared_ptr<const FunctionTable> table;
    std::int64_t cell = 1;  // voxels a side, of what the table is made from
};

// A block in one sub-volume is as that says. Of one that is cut, every line through a block's part has at
// least the least of the parts' rates; and those that pass it half-way in a column have what any part of that
// column says. Where nobody says anything there is no opacity.
FunctionTable merged(const BlockGrid& grid, const DirectionGrid& directions, Footprint footprint,
                     const std::vector<SubVolume>& parts);

}  // namespace shearwater::culling
