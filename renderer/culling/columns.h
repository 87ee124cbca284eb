#pragma once
// Opacity functions of columns: what every line of a direction's cell gathers between the two planes that
// bound a block along the line's principal axis w, if it passes through the block half-way.
//
//     a  |    b    |  c
//    ----+-------/-+---- w + 32
//        |      /  |
//        |     *   |      half-way
//        |    /    |
//    ----+---/-----+---- w
//
// In a block itself a line that clips a corner may meet nothing, and the smallest ratio of depth to thickness
// (OPOF 4) of a block that is not opaque to its very corners is none. Between the planes all lines of a
// direction have the same thickness, and those that pass a block only at a corner count where they are
// half-way.
//
// What of a line lies outside the sub-volume and its halo counts as clear. Only lines are looked at that stay
// in the cube from plane to plane, and pass half-way through the sub-volume's own cells.

#include <stop_token>

#include "common/base/workers.h"
#include "common/culling/block_grid.h"
#include "common/culling/direction_grid.h"
#include "common/culling/function_table.h"
#include "renderer/culling/cells.h"

namespace shearwater::culling {

// Of all blocks that a sub-volume has a part of. Empty if stopped before.
FunctionTable column_functions(const Cells& cells, const BlockGrid& grid, const volume::Box& box,
                               const DirectionGrid& directions, base::Workers& workers,
                               const std::stop_token& stop = {});

}  // namespace shearwater::culling
