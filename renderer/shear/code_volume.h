#pragma once
// Codes of the nodes in a box of some level of a cube: one copy that serves all three principal axes, or two.
//
// Codes lie in rows along axis 0, planes of rows, and so on, as in the cube, so that a tile's samples on a
// slice lie in a few long rows whatever the axis. Where axis 0 is the principal one they have to be turned,
// tile by tile, unless a second copy is kept that has rows along axis 1. What a transfer function may pass
// over is told by micro-bricks of 8^3 cells on a grid global to the level, each with the codes that occur on
// its planes, those it shares with its neighbours included; of its octants, more coarsely; and with those
// that a segment from one slice to the next may reach that begins in it. On level 0 the nodes are the cube's
// voxels.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "common/base/workers.h"
#include "common/volume/box.h"
#include "renderer/shear/code_array.h"

namespace shearwater::shear {

// The codes that occur in a part of the sub-volume.
struct CodeRange {
    std::uint16_t min = 65535;  // of the codes that are not blank; min > max when all are
    std::uint16_t max = 0;
    bool blanks = false;

    bool operator==(const CodeRange&) const = default;
    bool empty() const { return min > max; }
    void add(const CodeRange& other);
};

// The leading bytes of the codes that occur in an octant of a micro-brick and are not blank: min > max where
// there are none, or where it is outside the box.
struct OctantRange {
    std::uint8_t min = 255, max = 0;

    bool operator==(const OctantRange&) const = default;
};
// At x + 2 y + 4 z, x, y and z counting along the axes.
using Octants = std::array<OctantRange, 8>;

// A box's cells in cubes on the cube's grid, and what is known of each, axis 0 fastest.
class CodeGrid {
  public:
    CodeGrid() = default;
    CodeGrid(const volume::Box& box, std::int64_t edge);

    std::int64_t edge() const { return edge_; }
    const volume::Index3& counts() const { return counts_; }
    // Of the grid's first along an axis, in edges from the cube's first voxel.
    std::int64_t first(int axis) const { return first_[static_cast<std::size_t>(axis)]; }
    std::size_t index(const volume::Index3& at) const {
        return static_cast<std::size_t>((at[2] * counts_[1] + at[1]) * counts_[0] + at[0]);
    }
    std::span<const CodeRange> ranges() const { return ranges_; }
    std::span<CodeRange> ranges() { return ranges_; }

  private:
    std::int64_t edge_ = 1;
    volume::Index3 first_{}, counts_{};
    std::vector<CodeRange> ranges_;
};

class CodeVolume {
  public:
    static constexpr std::int64_t micro_edge = 8;
    static constexpr std::int64_t octant_edge = micro_edge / 2;

    CodeVolume() = default;
    // Blank throughout, with codes of 8 or 16 bits; std::bad_alloc where there is no room.
    CodeVolume(const volume::Box& box, int bits);

    const volume::Box& box() const { return codes_.box(); }
    // The nodes between which the sub-volume's own samples lie: all but a margin (volume::nodes_kept).
    const volume::Box& own() const { return own_; }
    int bits() const { return bits_; }
    std::size_t bytes() const;

    // As CodeArray has them, rows along axis 0.
    template <class Code>
    std::span<const Code> codes() const {
        return codes_.codes<Code>();
    }
    template <class Code>
    std::span<Code> codes() {
        return codes_.codes<Code>();
    }
    std::ptrdiff_t stride(int axis) const { return codes_.stride(axis); }
    std::size_t offset(const volume::Index3& p) const { return codes_.offset(p); }

    // Keeps a second copy of all codes as they are now, as large as the first; false if stopped before.
    // std::bad_alloc where there is no room.
    bool keep_turned(base::Workers& workers, const std::stop_token& stop);
    // What faces with a principal axis are best drawn from: codes whose rows run along another, if there are.
    const CodeArray& best_for(int principal_axis) const {
        return turned_ && codes_.adjacent_axis() == principal_axis ? *turned_ : codes_;
    }

    // Copies the codes of a box that both hold; false if stopped before.
    bool copy(const CodeVolume& from, const volume::Box& box, base::Workers& workers,
              const std::stop_token& stop);
    // Moves the box along axis 2, as CodeArray does; the first copy only.
    void move_planes(std::int64_t first) { codes_.move_planes(first); }

    // Finds out what the micro-bricks of the sub-volume's own nodes hold; false if stopped before.
    bool survey(const volume::Box& own, base::Workers& workers, const std::stop_token& stop);
    const CodeGrid& micro_bricks() const { return micro_bricks_; }
    // Of each of them.
    std::span<const Octants> octants() const { return octants_; }
    // The same of each with one node more on every side.
    std::span<const CodeRange> reaches() const { return reaches_; }

  private:
    volume::Box own_;
    int bits_ = 8;
    CodeArray codes_;
    std::optional<CodeArray> turned_;
    CodeGrid micro_bricks_;
    std::vector<Octants> octants_;
    std::vector<CodeRange> reaches_;
};

}  // namespace shearwater::shear
