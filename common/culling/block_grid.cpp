#include "common/culling/block_grid.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/volume/cell_grid.h"

namespace shearwater::culling {

using volume::Box;
using volume::Index3;

BlockGrid::BlockGrid(const Index3& n, std::int64_t edge) : edge_(edge), n_(n) {
    base::check(edge == 16 || edge == 32, "a block has 16 or 32 voxels a side");
    for (std::size_t a = 0; a < 3; ++a) {
        counts_[a] = volume::CellGrid{n, edge}.count(a);
    }
}

Index3 BlockGrid::at(std::size_t index) const {
    const auto i = static_cast<std::int64_t>(index);
    return {i % counts_[0], i / counts_[0] % counts_[1], i / counts_[0] / counts_[1]};
}

Box BlockGrid::box(const Index3& at) const {
    Box box;
    for (std::size_t a = 0; a < 3; ++a) {
        box.lo[a] = at[a] * edge_;
        box.hi[a] = std::min(box.lo[a] + edge_, n_[a] - 1);
    }
    return box;
}

Box BlockGrid::blocks_of(const Box& box) const {
    Box blocks;
    for (std::size_t a = 0; a < 3; ++a) {
        blocks.lo[a] = box.lo[a] / edge_;
        blocks.hi[a] = (box.hi[a] - 1) / edge_ + 1;
    }
    return blocks;
}

std::size_t BlockSet::count() const {
    return static_cast<std::size_t>(std::count_if(in_.begin(), in_.end(), [](auto in) { return in != 0; }));
}

}  // namespace shearwater::culling
