#include "renderer/shear/seen.h"

#include <algorithm>
#include <array>
#include <functional>

namespace shearwater::shear {

namespace {

// Which cubes of a grid, whose edge is so many voxels, have a part of a visible block. Cubes and blocks lie
// in one another: the one's edge is the other's, times a power of two.
class Seen {
  public:
    Seen(const CodeGrid& grid, int level, const culling::VisibleBlocks& visible)
        : grid_(grid), visible_(visible) {
        const std::int64_t edge = grid.edge() << level, block_edge = visible.grid.edge();
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const std::int64_t end = visible.grid.counts()[a] - 1;
            for (std::int64_t n = 0; n < grid.counts()[a]; ++n) {
                const std::int64_t voxel = (grid.first(axis) + n) * edge;
                // A coarse level's nodes may lie outside the cube.
                blocks_[a].push_back(
                    {std::min(voxel / block_edge, end), std::min((voxel + edge - 1) / block_edge, end)});
            }
        }
    }

    // Calls each(index, whether it is seen) on the cubes of a layer across axis 2.
    template <class Each>
    void for_layer(std::int64_t z, const Each& each) const {
        const auto row_length = static_cast<std::size_t>(visible_.grid.counts()[0]);
        const std::span<const std::uint8_t> bytes = visible_.blocks.bytes();
        std::vector<std::uint8_t> seen(row_length);  // along axis 0, in any of the blocks across it
        std::size_t index = grid_.index({0, 0, z});
        for (std::int64_t y = 0; y < grid_.counts()[1]; ++y) {
            std::ranges::fill(seen, std::uint8_t{0});
            const Blocks& across_z = blocks_[2][static_cast<std::size_t>(z)];
            const Blocks& across_y = blocks_[1][static_cast<std::size_t>(y)];
            for (std::int64_t bz = across_z.first; bz <= across_z.last; ++bz) {
                for (std::int64_t by = across_y.first; by <= across_y.last; ++by) {
                    const auto row = bytes.subspan(visible_.grid.index({0, by, bz}), row_length);
                    std::ranges::transform(seen, row, seen.begin(), std::bit_or<>());
                }
            }
            for (const auto& [first, last] : blocks_[0]) {
                bool any = false;
                for (std::int64_t bx = first; bx <= last; ++bx) {
                    any = any || seen[static_cast<std::size_t>(bx)] != 0;
                }
                each(index++, any);
            }
        }
    }

  private:
    // That a cube has a part of along an axis.
    struct Blocks {
        std::int64_t first, last;
    };

    const CodeGrid& grid_;
    const culling::VisibleBlocks& visible_;
    std::array<std::vector<Blocks>, 3> blocks_;
};

}  // namespace

bool sees_any(const volume::Box& box, const culling::VisibleBlocks& visible) {
    const volume::Box blocks = visible.grid.blocks_of(box);
    for (std::int64_t z = blocks.lo[2]; z < blocks.hi[2]; ++z) {
        for (std::int64_t y = blocks.lo[1]; y < blocks.hi[1]; ++y) {
            const auto row =
                visible.blocks.bytes().subspan(visible.grid.index({blocks.lo[0], y, z}),
                                               static_cast<std::size_t>(blocks.hi[0] - blocks.lo[0]));
            if (std::ranges::any_of(row, [](std::uint8_t seen) { return seen != 0; })) {
                return true;
            }
        }
    }
    return false;
}

std::vector<Content> seen_contents(const CodeVolume& nodes, int level, std::span<const Content> contents,
                                   const culling::VisibleBlocks& visible, base::Workers& workers) {
    const Seen all(nodes.micro_bricks(), level, visible);
    std::vector<Content> left(contents.begin(), contents.end());
    workers.for_each(nodes.micro_bricks().counts()[2], [&](std::int64_t z) {
        all.for_layer(z, [&](std::size_t index, bool seen) {
            if (!seen) {
                left[index].opaque_octants = 0;
            }
        });
    });
    return left;
}

std::uint64_t hidden_bricks(const BrickVolume& volume, std::span<const std::uint8_t> opaque,
                            const culling::VisibleBlocks& visible) {
    const Seen all(volume.bricks(), 0, visible);
    std::uint64_t hidden = 0;
    for (std::int64_t z = 0; z < volume.bricks().counts()[2]; ++z) {
        all.for_layer(z,
                      [&](std::size_t index, bool seen) { hidden += opaque[index] != 0 && !seen ? 1 : 0; });
    }
    return hidden;
}

}  // namespace shearwater::shear
