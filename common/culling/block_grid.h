#pragma once
// The blocks that visibility is decided for (POF 3): cubes of cells on a grid global to the cube, whatever
// the tree that renders it.

#include <cstdint>
#include <span>
#include <vector>

#include "common/volume/box.h"

namespace shearwater::culling {

class BlockGrid {
  public:
    static constexpr std::int64_t default_edge = 32;

    BlockGrid() = default;
    // Over a cube of n voxels; an edge is 16 or 32 voxels.
    explicit BlockGrid(const volume::Index3& n, std::int64_t edge = default_edge);

    const volume::Index3& voxels() const { return n_; }  // of the cube
    std::int64_t edge() const { return edge_; }
    const volume::Index3& counts() const { return counts_; }
    std::size_t size() const { return static_cast<std::size_t>(counts_[0] * counts_[1] * counts_[2]); }
    // Axis 0 fastest.
    std::size_t index(const volume::Index3& at) const {
        return static_cast<std::size_t>((at[2] * counts_[1] + at[1]) * counts_[0] + at[0]);
    }
    volume::Index3 at(std::size_t index) const;
    // What a block owns, in voxels: the last along an axis may be smaller.
    volume::Box box(const volume::Index3& at) const;
    // The blocks that a box of voxels has a part of: from lo to hi, the latter not included.
    volume::Box blocks_of(const volume::Box& box) const;

    bool operator==(const BlockGrid&) const = default;

  private:
    std::int64_t edge_ = default_edge;
    volume::Index3 n_{}, counts_{};
};

// A set of a grid's blocks, a byte each. Bytes are set by several threads at once: never cleared meanwhile.
class BlockSet {
  public:
    BlockSet() = default;
    explicit BlockSet(std::size_t blocks, bool all = false) : in_(blocks, all ? 1 : 0) {}

    std::size_t size() const { return in_.size(); }
    bool contains(std::size_t block) const { return in_[block] != 0; }
    std::span<std::uint8_t> bytes() { return in_; }
    std::span<const std::uint8_t> bytes() const { return in_; }
    std::size_t count() const;

    bool operator==(const BlockSet&) const = default;

  private:
    std::vector<std::uint8_t> in_;
};

// What a frame may see.
struct VisibleBlocks {
    BlockGrid grid;
    BlockSet blocks;
};

}  // namespace shearwater::culling
