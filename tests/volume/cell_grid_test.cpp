#include "common/volume/cell_grid.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace shearwater::volume {
namespace {

TEST(CellGrid, CountsTheLastWhetherCutOffOrNot) {
    const CellGrid grid{{9, 10, 12}, 4};
    EXPECT_EQ(grid.count(0), 2);
    EXPECT_EQ(grid.count_uncut(0), 2);
    EXPECT_EQ(grid.count(1), 3);
    EXPECT_EQ(grid.count_uncut(1), 2);
    EXPECT_EQ(grid.count(2), 3);
    EXPECT_EQ(grid.count_uncut(2), 2);
}

// A voxel's cell belongs to one box of a division at most, and only to one that has all of it that there is.
TEST(CellGrid, GivesACellToTheBoxThatHasAllOfIt) {
    for (const std::int64_t end : {20, 21, 22, 23, 24}) {
        const Index3 n{end + 1, 9, 9};
        const CellGrid grid{n, 4};
        for (std::int64_t plane = 1; plane < end; ++plane) {
            Box left = whole(n), right = left;
            left.hi[0] = right.lo[0] = plane;
            for (const Box& box : {left, right}) {
                const Box cells = grid.within(box);
                for (std::int64_t cell = 0; cell < grid.count(0); ++cell) {
                    const bool all = box.lo[0] <= cell * 4 && std::min(cell * 4 + 4, end) <= box.hi[0];
                    EXPECT_EQ(cells.lo[0] <= cell && cell < cells.hi[0], all)
                        << end << ' ' << plane << ' ' << cell;
                }
                EXPECT_LE(cells.lo[0], cells.hi[0]);
                EXPECT_EQ(cells.cells(1), 2);
            }
        }
    }
}

}  // namespace
}  // namespace shearwater::volume
