#pragma once
// The directions that opacity functions are tables over (POF 3.1, Figure 1): cells of equal steps of theta,
// from axis 2, and phi, about it from axis 0 towards axis 1, in voxel space. What a block lets through does
// not depend on which way a line is gone along, so half of them suffice: those with phi from 0 to pi.
//
// A function's entry holds for every line whose direction lies in its cell, not for a sample of them. Along a
// principal axis w the lines of a cell have slopes du/dw and dv/dw, u = (w + 1) % 3 and v = (w + 2) % 3, in
// intervals.

#include <optional>
#include <vector>

namespace shearwater::culling {

struct Interval {
    double lo = 0, hi = 0;
    bool operator==(const Interval&) const = default;
};

struct Slopes {
    Interval u, v;
};

class DirectionGrid {
  public:
    // Lines may be asked for along an axis that is not quite their principal one: an image's edge is drawn
    // a little beyond.
    static constexpr double steepest = 1.0625;

    static constexpr int default_side = 36;

    // So many cells along theta and along phi, a multiple of 4.
    explicit DirectionGrid(int side);

    int side() const { return side_; }
    int cells() const { return side_ * side_ / 2; }

    // The slopes along an axis of the lines of a cell that are no steeper to it than `steepest`; none where
    // there is no such line.
    std::optional<Slopes> slopes(int cell, int axis) const;

    // Puts into `out` the cells of all lines with slopes in these intervals, no steeper than 1.25.
    void cells_of(int axis, const Slopes& slopes, std::vector<int>& out) const;

    bool operator==(const DirectionGrid&) const = default;

  private:
    int side_;
};

}  // namespace shearwater::culling
