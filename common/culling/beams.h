#pragma once
// The beams that a face's image is cut into where it is decided what is visible, and where they go through
// the blocks.
//
//     eye >===  slab 0  |  slab 1  |     a beam: a few pixels a side, with all of their rays
//              [a][b]   |[a][b][c] |     a slab: blocks on the same planes across the face's axis
//
// A beam has a side along u and one along v (view/factorisation.h), which are laid apart from one another:
// what it meets of a slab is all blocks that are in what either side meets.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/culling/block_grid.h"
#include "common/culling/direction_grid.h"
#include "common/culling/settings.h"
#include "common/view/factorisation.h"

namespace shearwater::culling {

// A slab of blocks, as far as it is in front of the eye.
struct Slab {
    std::int64_t block;
    double near, far;  // planes
    double middle;
    double thickness;  // voxels, 0 where the eye is in it or near
};

// Blocks along an axis, [first, last].
struct Run {
    std::int32_t first, last;
    bool empty() const { return last < first; }
    bool contains(std::int64_t block) const { return first <= block && block <= last; }
};

// Along u or v: where a beam's rays are, at + slope * w.
struct Side {
    Interval at, slope;
};

// Where a side has a slab's functions count, and whose.
struct Counted {
    Run by;           // or none
    float near, far;  // of the slab, how far along the principal axis in front of where that is counted from
};

// The beams of a rectangle of the image: those of the sides [u0, u1) and [v0, v1).
struct Tile {
    std::size_t u0, u1, v0, v1;
};

// Cells of directions of a tile's beams, which are of groups of beams side by side.
struct TileCells {
    static constexpr std::size_t group = 2;  // beams a side

    std::vector<int> cells;             // of a group after the other, in rows along u
    std::vector<std::size_t> first_of;  // of each group, and of one beyond the last

    // Of a beam of the tile.
    std::span<const int> of(const Tile& tile, std::size_t u, std::size_t v) const {
        const std::size_t row = (tile.u1 - tile.u0 + group - 1) / group;
        const std::size_t n = (v - tile.v0) / group * row + (u - tile.u0) / group;
        return std::span(cells).subspan(first_of[n], first_of[n + 1] - first_of[n]);
    }
};

class Beams {
  public:
    Beams(const view::Factorisation& factorisation, const view::Face& face, const BlockGrid& grid);

    const std::vector<Side>& u() const { return u_; }
    const std::vector<Side>& v() const { return v_; }
    // Front to back.
    const std::vector<Slab>& slabs() const { return slabs_; }

    // What each of some sides, along an in-plane axis, meets of each slab, of the grid: one side after the
    // other.
    std::vector<Run> met(const std::vector<Side>& sides, int axis) const;
    // Where functions of a footprint count of each slab, laid out alike. None is of lines that go half-way
    // past a block and come in or go out by the sides of the cube, or of what is shown of it; those of blocks
    // are of what is inside. Nor is it known by how much a ray's first or last sample there is less than a
    // step; and none is of a part of a block.
    std::vector<Counted> counted(const std::vector<Side>& sides, int axis, Footprint footprint) const;
    // The image as tiles, each beside the one before; their beams' groups lie alike however it is cut.
    std::vector<Tile> tiles() const;
    // Of all of a tile's beams' lines, and perhaps some more.
    TileCells cells(const Tile& tile, const DirectionGrid& directions) const;
    // World length of a beam's shortest ray from plane to plane of voxels, in the smallest distance of two.
    double shortest_step(const Side& u, const Side& v) const;

  private:
    bool perspective() const { return f_.projection == view::Projection::perspective; }
    // From where positions along the principal axis are counted.
    double origin() const { return perspective() ? f_.eye[face_.axis] : 0; }
    std::vector<Side> sides(int axis, double origin, double pitch, int count, int pixels) const;
    void lay_slabs();
    static Interval between(const Side& side, double w0, double w1);
    Run run(const Interval& interval) const;
    Interval inside(const Side& side, std::size_t axis) const;

    const view::Factorisation& f_;
    const view::Face& face_;
    const BlockGrid& grid_;
    double step_;                          // at most from slice to slice, in voxels
    std::array<double, 3> begins_, ends_;  // of what functions are of, in voxels
    std::array<Run, 3> whole_;             // blocks that are shown from end to end
    std::vector<Side> u_, v_;
    std::vector<Slab> slabs_;
};

}  // namespace shearwater::culling
