#include "common/culling/direction_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "common/culling/block_grid.h"

namespace shearwater::culling {
namespace {

// Of a line of any direction: its slopes along each axis that it is not too steep for.
struct Line {
    std::array<double, 3> d;
    double u(int axis) const { return along(axis + 1) / along(axis); }
    double v(int axis) const { return along(axis + 2) / along(axis); }
    bool gentle(int axis, double most) const {
        return std::abs(u(axis)) <= most && std::abs(v(axis)) <= most;
    }

  private:
    double along(int axis) const { return d[static_cast<std::size_t>(axis % 3)]; }
};

bool holds(const Interval& interval, double x) {
    return interval.lo <= x && x <= interval.hi;
}

// The cells that are said to hold a line hold it: its slopes are among theirs.
TEST(DirectionGrid, FindsTheCellsOfEveryLine) {
    std::mt19937 random(1);
    std::normal_distribution<double> part;
    for (const int side : {4, 12, 36}) {
        const DirectionGrid grid(side);
        for (int n = 0; n < 5000; ++n) {
            Line line{{part(random), part(random), part(random)}};
            if (n % 10 == 0) {
                line.d[static_cast<std::size_t>(n / 10 % 3)] = 0;  // on a border
            }
            for (int axis = 0; axis < 3; ++axis) {
                if (!line.gentle(axis, DirectionGrid::steepest)) {
                    continue;
                }
                const double u = line.u(axis), v = line.v(axis);
                std::vector<int> cells;
                grid.cells_of(axis, {{u, u}, {v, v}}, cells);
                ASSERT_FALSE(cells.empty());
                ASSERT_LE(cells.size(), 2U * static_cast<unsigned>(side));
                bool held = false;
                for (const int cell : cells) {
                    const auto slopes = grid.slopes(cell, axis);
                    held = held || (slopes && holds(slopes->u, u) && holds(slopes->v, v));
                }
                EXPECT_TRUE(held) << side << ", axis " << axis << ": " << u << ", " << v;
            }
        }
    }
}

TEST(DirectionGrid, FindsTheCellsOfABeamOfLines) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> slope(-1, 1);
    std::exponential_distribution<double> width(8);
    const DirectionGrid grid(36);
    std::vector<int> cells, inside;
    for (int n = 0; n < 3000; ++n) {
        Slopes beam{{slope(random), 0}, {slope(random), 0}};
        beam.u.hi = std::min(beam.u.lo + width(random), 1.0);
        beam.v.hi = std::min(beam.v.lo + width(random), 1.0);
        const int axis = n % 3;
        grid.cells_of(axis, beam, cells);
        for (int i = 0; i <= 4; ++i) {
            for (int j = 0; j <= 4; ++j) {
                const double u = beam.u.lo + i * (beam.u.hi - beam.u.lo) / 4;
                const double v = beam.v.lo + j * (beam.v.hi - beam.v.lo) / 4;
                grid.cells_of(axis, {{u, u}, {v, v}}, inside);
                EXPECT_TRUE(std::any_of(
                    inside.begin(), inside.end(),
                    [&](int cell) { return std::binary_search(cells.begin(), cells.end(), cell); }))
                    << axis << ": " << u << ", " << v;
            }
        }
    }
}

TEST(DirectionGrid, HasNarrowCells) {
    const DirectionGrid grid(36);
    ASSERT_EQ(grid.cells(), 648);
    int axes = 0;
    for (int cell = 0; cell < grid.cells(); ++cell) {
        for (int axis = 0; axis < 3; ++axis) {
            if (const auto slopes = grid.slopes(cell, axis)) {
                ++axes;
                EXPECT_LT(slopes->u.hi - slopes->u.lo, 0.45);
                EXPECT_LT(slopes->v.hi - slopes->v.lo, 0.45);
            }
        }
    }
    EXPECT_LT(axes, 2 * grid.cells());
}

TEST(BlockGrid, CoversTheCube) {
    const BlockGrid grid({65, 33, 34});
    EXPECT_EQ(grid.counts(), (volume::Index3{2, 1, 2}));
    EXPECT_EQ(grid.box({1, 0, 1}), (volume::Box{{32, 0, 32}, {64, 32, 33}}));
    EXPECT_EQ(grid.blocks_of({{31, 0, 32}, {64, 32, 33}}), (volume::Box{{0, 0, 1}, {2, 1, 2}}));
    for (std::size_t n = 0; n < grid.size(); ++n) {
        EXPECT_EQ(grid.index(grid.at(n)), n);
    }
    EXPECT_EQ(BlockGrid({65, 33, 34}, 16).size(), 4U * 2 * 3);
}

}  // namespace
}  // namespace shearwater::culling
