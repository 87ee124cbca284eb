#include "renderer/shear/seen.h"

#include <algorithm>

namespace shearwater::shear {

using volume::Index3;

namespace {

// Whether the cube of a grid whose edge is so many voxels has a part of a visible block. Cubes and blocks lie
// in one another: the one's edge is the other's, times a power of two.
class Seen {
  public:
    Seen(const CodeGrid& grid, int level, const culling::VisibleBlocks& visible)
        : grid_(grid), visible_(visible), edge_(grid.edge() << level) {}

    bool operator()(const Index3& at) const {
        Index3 first, last;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const std::int64_t voxel = (grid_.first(axis) + at[a]) * edge_;
            const std::int64_t end = visible_.grid.counts()[a] - 1;
            // A coarse level's nodes may lie outside the cube.
            first[a] = std::min(voxel / visible_.grid.edge(), end);
            last[a] = std::min((voxel + edge_ - 1) / visible_.grid.edge(), end);
        }
        Index3 block;
        for (block[2] = first[2]; block[2] <= last[2]; ++block[2]) {
            for (block[1] = first[1]; block[1] <= last[1]; ++block[1]) {
                for (block[0] = first[0]; block[0] <= last[0]; ++block[0]) {
                    if (visible_.blocks.contains(visible_.grid.index(block))) {
                        return true;
                    }
                }
            }
        }
        return false;
    }

  private:
    const CodeGrid& grid_;
    const culling::VisibleBlocks& visible_;
    std::int64_t edge_;
};

// Calls each(index, whether it is seen) on all cubes of a grid.
template <class Each>
void for_all(const CodeGrid& grid, int level, const culling::VisibleBlocks& visible, const Each& each) {
    const Seen seen(grid, level, visible);
    Index3 at;
    std::size_t index = 0;
    for (at[2] = 0; at[2] < grid.counts()[2]; ++at[2]) {
        for (at[1] = 0; at[1] < grid.counts()[1]; ++at[1]) {
            for (at[0] = 0; at[0] < grid.counts()[0]; ++at[0]) {
                each(index++, seen(at));
            }
        }
    }
}

}  // namespace

std::vector<Content> seen_contents(const CodeVolume& nodes, int level, std::span<const Content> contents,
                                   const culling::VisibleBlocks& visible) {
    std::vector<Content> left(contents.begin(), contents.end());
    for_all(nodes.micro_bricks(), level, visible, [&](std::size_t index, bool seen) {
        if (!seen) {
            left[index].opaque_octants = 0;
        }
    });
    return left;
}

std::uint64_t hidden_bricks(const BrickVolume& volume, std::span<const std::uint8_t> opaque,
                            const culling::VisibleBlocks& visible) {
    std::uint64_t hidden = 0;
    for_all(volume.bricks(), 0, visible,
            [&](std::size_t index, bool seen) { hidden += opaque[index] != 0 && !seen ? 1 : 0; });
    return hidden;
}

}  // namespace shearwater::shear
