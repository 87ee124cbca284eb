#pragma once
// A box's voxels row by row, as they lie in memory.

#include <cstddef>
#include <span>

#include "common/volume/box.h"

namespace shearwater::synthetic {

// Calls row(y, z, values) for each row of the box's planes.
template <class Row>
void for_each_row(const volume::Box& box, std::span<float> out, const Row& row) {
    const auto length = static_cast<std::size_t>(box.planes(0));
    std::size_t at = 0;
    for (std::int64_t z = box.lo[2]; z <= box.hi[2]; ++z) {
        for (std::int64_t y = box.lo[1]; y <= box.hi[1]; ++y) {
            row(y, z, out.subspan(at, length));
            at += length;
        }
    }
}

}  // namespace shearwater::synthetic
