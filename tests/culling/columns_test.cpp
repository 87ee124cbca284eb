#include "renderer/culling/columns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "common/culling/rates.h"
#include "common/volume/levels.h"
#include "renderer/culling/column_kernel.h"
#include "tests/culling/block.h"
#include "tests/support/reference_cubes.h"

namespace shearwater::culling {
namespace {

using volume::Box;
using volume::Index3;

// What a line gathers between a block's planes along an axis, in depth along the distance of two nodes:
// samples on planes 1 / per_cell apart, or the segments between those. At the cube's ends one counts for what
// it stands for in the cube (shear/face_plan.h).
double depth_along(const Block& block, const Box& between, int axis, double u, double v,
                   const std::array<double, 3>& through, int per_cell, bool segments,
                   const std::array<double, 3>& last) {
    const auto w = static_cast<std::size_t>(axis);
    const auto on_plane = [&](std::int64_t k) {
        std::array<double, 3> p = through;
        p[w] = static_cast<double>(k) / per_cell;
        p[(w + 1) % 3] += u * (p[w] - through[w]);
        p[(w + 2) % 3] += v * (p[w] - through[w]);
        return p;
    };
    double depth = 0;
    for (std::int64_t k = between.lo[w] * per_cell; k < between.hi[w] * per_cell; ++k) {
        const std::array<double, 3> p = on_plane(k), q = on_plane(k + 1);
        bool inside = true;
        for (std::size_t a = 0; a < 3; ++a) {
            inside = inside && 0 <= p[a] && p[a] < last[a];
        }
        if (inside) {
            const double half = 0.5 / per_cell;
            depth += (segments ? block.extinction(p, q) : block.extinction(p)) *
                     (std::min(half, p[w]) + std::min(half, last[w] - p[w]));
        }
    }
    return depth;
}

// Whether a line is inside the cube's sides from a node before a block's planes to one behind.
bool stays_inside(const Box& between, int axis, double u, double v, const std::array<double, 3>& through,
                  const std::array<double, 3>& ends) {
    const auto w = static_cast<std::size_t>(axis);
    for (const std::int64_t plane : {between.lo[w] - 1, between.hi[w] + 1}) {
        const double far = static_cast<double>(plane) - through[w];
        for (const auto& [a, slope] : {std::pair{(w + 1) % 3, u}, {(w + 2) % 3, v}}) {
            const double at = through[a] + slope * far;
            if (at < 0 || at >= ends[a]) {
                return false;
            }
        }
    }
    return true;
}

struct Lines {
    int side;
    int count;
    unsigned seed;
    bool octants = false;
    int level = 0;
};

// Lines of all directions through a part's blocks: none gathers less in the whole than its direction's code
// says. All in nodes of the level.
void expect_below_every_line(const shear::BrickVolume& whole, const shear::BrickVolume& volume,
                             const view::TransferFunction& tf, const Lines& lines) {
    base::Workers workers(2);
    const std::int64_t node = std::int64_t{1} << lines.level;
    const std::int64_t cell = lines.octants ? 4 : node;
    const Index3 n = volume.cube();
    const Index3 last = volume::last_nodes(n, lines.level);
    std::array<double, 3> ends;  // the cube's, where cells may be cut off
    for (std::size_t a = 0; a < 3; ++a) {
        ends[a] = static_cast<double>(n[a] - 1) / static_cast<double>(node);
    }
    const BlockGrid grid(n);
    const DirectionGrid directions(lines.side);
    const Block all(whole, tf, {{}, last}, lines.level);
    const LeastExtinctions extinctions = all.extinctions();
    const Cells cells_of = lines.octants ? cells_of_octants(volume, extinctions)
                                         : cells_of_nodes(volume, lines.level, extinctions);
    const FunctionTable table = column_functions(cells_of, grid, volume.box(), directions, workers);
    ASSERT_EQ(table.codes.size(), table.block_count() * static_cast<std::size_t>(directions.cells()));
    std::mt19937 random(lines.seed);
    std::uniform_real_distribution<double> slope(-1, 1), share(0, 1);
    std::vector<int> cells;
    int opaque = 0;
    for (int line = 0; line < lines.count; ++line) {
        const int axis = line % 3;
        const auto w = static_cast<std::size_t>(axis);
        const double u = slope(random), v = slope(random);
        Index3 at;
        Box block;
        std::array<double, 3> through;
        bool any = true;
        for (std::size_t a = 0; a < 3; ++a) {
            at[a] = table.blocks.lo[a] +
                    static_cast<std::int64_t>(share(random) *
                                              static_cast<double>(table.blocks.hi[a] - table.blocks.lo[a]));
            block.lo[a] = at[a] * grid.edge() / node;
            block.hi[a] = std::min(block.lo[a] + grid.edge() / node, last[a]);
            // Only where the sub-volume has it.
            const auto lo = static_cast<double>(
                std::max(block.lo[a], (volume.box().lo[a] + cell - 1) / cell * cell / node));
            const std::int64_t end = volume.box().hi[a];
            const double of_whole = static_cast<double>(end / cell * cell / node);
            const double hi =
                std::min(static_cast<double>(block.hi[a]), end == n[a] - 1 ? ends[a] : of_whole);
            any = any && (lo < hi || a == w);
            through[a] = lo + share(random) * (hi - lo);
        }
        if (!any) {
            continue;
        }
        through[w] = static_cast<double>(block.lo[w]) +
                     static_cast<double>(grid.edge()) / static_cast<double>(node) / 2;
        directions.cells_of(axis, {{u, u}, {v, v}}, cells);
        const std::size_t index = static_cast<std::size_t>(
            ((at[2] - table.blocks.lo[2]) * table.blocks.cells(1) + at[1] - table.blocks.lo[1]) *
                table.blocks.cells(0) +
            at[0] - table.blocks.lo[0]);
        int code = most_code;
        for (const int direction : cells) {
            code = std::min<int>(
                code, table.codes[static_cast<std::size_t>(direction) * table.block_count() + index]);
        }
        opaque += code > 0 ? 1 : 0;
        if (!stays_inside(block, axis, u, v, through, ends)) {
            continue;
        }
        for (const auto& [per_cell, segments] : {std::pair{1, false}, {2, false}, {1, true}, {2, true}}) {
            const double depth = depth_along(all, block, axis, u, v, through, per_cell, segments, ends);
            EXPECT_GE(depth * static_cast<double>(node) * (1 + 1e-6),
                      all.least_of(code) * static_cast<double>(grid.box(at).cells(axis)))
                << axis << ": " << u << ", " << v << " by " << per_cell << (segments ? " segments" : "");
        }
    }
    EXPECT_GT(opaque, lines.octants ? 0 : lines.count / 20);
}

TEST(ColumnFunctions, AreBelowEveryLine) {
    base::Workers workers(2);
    test::FloatCube noise = test::noise_cube({70, 66, 67});
    test::FloatCube waves = shells({70, 66, 67});
    unsigned seed = 0;
    for (test::FloatCube* cube : {&noise, &waves}) {
        for (const int bits : {8, 16}) {
            for (const Box& box :
                 {volume::whole(cube->n()), Box{{0, 11, 3}, {40, 65, 50}}, Box{{37, 0, 0}, {69, 65, 31}}}) {
                const auto volume = test::bricks_of(*cube, box, workers, {.bits = bits});
                const auto whole = test::bricks_of(*cube, workers, {.bits = bits});
                for (const auto& tf :
                     {ramp(0.2, 0.02, 0.9, 0.3), ramp(0.1, 0.4, 0.5, 0.05), step(0.3, 0.02, 0.3)}) {
                    expect_below_every_line(whole, volume, tf, {12, 300, ++seed});
                    expect_below_every_line(whole, volume, tf, {12, 300, ++seed, true});
                }
            }
        }
    }
    const auto volume = test::bricks_of(waves, workers);
    expect_below_every_line(volume, volume, ramp(0.1, 0.01, 0.9, 0.5), {36, 3000, 77});
    expect_below_every_line(volume, volume, ramp(0.1, 0.01, 0.9, 0.5), {36, 3000, 78, true});
}

// Also of coarser levels, whose cells across a sub-volume's faces nobody tells of.
TEST(ColumnFunctions, AreBelowEveryLineOnCoarseLevels) {
    base::Workers workers(2);
    const Index3 n{150, 131, 139};
    test::FloatCube waves = shells(n);
    const auto whole = test::bricks_of(waves, workers);
    ASSERT_EQ(whole.levels(), 3);
    unsigned seed = 100;
    for (const Box& box :
         {volume::whole(n), Box{{0, 13, 6}, {77, 130, 101}}, Box{{77, 13, 0}, {149, 130, 138}}}) {
        const auto volume = test::bricks_of(waves, box, workers);
        for (const int level : {1, 2}) {
            for (const auto& tf : {ramp(0.2, 0.02, 0.9, 0.3), step(0.3, 0.02, 0.3)}) {
                expect_below_every_line(whole, volume, tf, {12, 400, ++seed, false, level});
            }
        }
    }
}

// A wall is opaque to all lines across it, and to none along it.
TEST(ColumnFunctions, DependOnTheDirection) {
    base::Workers workers(1);
    test::FloatCube cube({97, 97, 97},
                         [](double x, double, double) { return 44 < x && x < 54 ? 1.0F : 0.0F; });
    const auto volume = test::bricks_of(cube, workers);
    const Block all(volume, ramp(0.4, 0, 0.6, 0.5), volume.box());
    const BlockGrid grid(cube.n());
    const DirectionGrid directions(36);
    const LeastExtinctions extinctions = all.extinctions();
    const auto table =
        column_functions(cells_of_nodes(volume, 0, extinctions), grid, volume.box(), directions, workers);
    const auto rate_along = [&](int axis, double u, double v) {
        std::vector<int> cells;
        directions.cells_of(axis, {{u, u}, {v, v}}, cells);
        return all.least_of(table.codes[static_cast<std::size_t>(cells.at(0)) * 27 + grid.index({1, 1, 1})]);
    };
    EXPECT_GT(32 * rate_along(0, 0.01, 0.01), 4);
    EXPECT_GT(32 * rate_along(0, -0.5, 0.6), 4);
    EXPECT_EQ(rate_along(1, 0.01, 0.01), 0);
    EXPECT_EQ(rate_along(2, 0.01, 0.01), 0);
}

TEST(ColumnFunctions, AreExactWhereAllIsAlike) {
    base::Workers workers(2);
    test::FloatCube cube({97, 97, 97}, [](double, double, double) { return 0.5F; });
    const auto volume = test::bricks_of(cube, workers);
    for (const double opacity : {0.003, 0.05, 0.3}) {
        const Block all(volume, ramp(0, opacity, 1, opacity), volume.box());
        const LeastExtinctions extinctions = all.extinctions();
        const auto table = column_functions(cells_of_nodes(volume, 0, extinctions), BlockGrid(cube.n()),
                                            volume.box(), DirectionGrid(36), workers);
        for (std::size_t cell = 0; cell < 648; ++cell) {
            const double rate = all.least_of(table.codes[cell * 27 + 13]);  // of the innermost block
            EXPECT_LE(rate, -std::log1p(-opacity));
            EXPECT_GE(rate, 0.9 * -std::log1p(-opacity));
        }
    }
}

// Wherever a bundle's lines are in a layer, from its one plane to the other, is a cell that counts.
TEST(ColumnKernel, ReachesAllThatLinesPass) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> share(0, 1);
    const DirectionGrid grid(12);
    for (int n = 0; n < 300; ++n) {
        if (const auto slopes = grid.slopes(static_cast<int>(random() % 72U), n % 3)) {
            const ColumnSheaf sheaf(*slopes, 0, 32, 16);
            const double slope = slopes->u.lo + share(random) * (slopes->u.hi - slopes->u.lo);
            const double from = share(random);  // in cell 0 half-way
            for (int layer = 0; layer < 32; ++layer) {
                const Reach& reach = sheaf.u[static_cast<std::size_t>(layer)];
                for (const double w : {0.0, share(random), 1.0}) {
                    const double at = from + slope * (layer + w - 16);
                    EXPECT_LE(reach.first, at);
                    EXPECT_GE(reach.last + 1, at);
                }
            }
        }
    }
}

TEST(ColumnKernel, IsItsDefinition) {
    std::mt19937 random(5);
    const DirectionGrid grid(12);
    std::vector<std::uint16_t> cells(32 * 80 * 160);
    for (std::uint16_t& units : cells) {
        units = static_cast<std::uint16_t>(random() % 2048);
    }
    for (int n = 0; n < 200; ++n) {
        const int axis = n % 3;
        const auto slopes = grid.slopes(static_cast<int>(random() % 72U), axis);
        if (!slopes) {
            continue;
        }
        const int layers = 1 + static_cast<int>(random() % 32U);
        const int first = static_cast<int>(random() % static_cast<unsigned>(33 - layers));
        const ColumnSheaf sheaf(*slopes, first, layers, 16);
        const ColumnCells block{.first = &cells[20 * 160 + 24],
                                .row = 160,
                                .layer = 80 * 160,
                                .bundles_u = 1 + static_cast<int>(random() % 32U),
                                .bundles_v = 1 + static_cast<int>(random() % 32U)};
        ASSERT_EQ(least_depth(block, sheaf), least_depth_by_definition(block, sheaf));
    }
}

}  // namespace
}  // namespace shearwater::culling
