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

// What a line gathers between a block's planes along an axis, in depth along the distance of two voxels:
// samples on planes 1 / per_cell apart. Those within a sample of the cube's ends count half.
double depth_along(const Block& block, const Box& between, int axis, double u, double v,
                   const std::array<double, 3>& through, int per_cell, const Index3& n) {
    const auto w = static_cast<std::size_t>(axis);
    double depth = 0;
    for (std::int64_t k = between.lo[w] * per_cell; k < between.hi[w] * per_cell; ++k) {
        std::array<double, 3> p = through;
        p[w] = static_cast<double>(k) / per_cell;
        p[(w + 1) % 3] += u * (p[w] - through[w]);
        p[(w + 2) % 3] += v * (p[w] - through[w]);
        bool inside = true, at_end = false;
        for (std::size_t a = 0; a < 3; ++a) {
            inside = inside && 0 <= p[a] && p[a] < static_cast<double>(n[a] - 1);
            at_end = at_end || (a == w && (p[a] < 1 || p[a] >= static_cast<double>(n[a] - 2)));
        }
        if (inside) {
            depth += block.extinction(p) * (at_end ? 0.5 : 1) / per_cell;
        }
    }
    return depth;
}

// Whether a line is inside the cube's sides from a voxel before a block's planes to one behind.
bool stays_inside(const Box& between, int axis, double u, double v, const std::array<double, 3>& through,
                  const Index3& n) {
    const auto w = static_cast<std::size_t>(axis);
    for (const std::int64_t plane : {between.lo[w] - 1, between.hi[w] + 1}) {
        const double far = static_cast<double>(plane) - through[w];
        for (const auto& [a, slope] : {std::pair{(w + 1) % 3, u}, {(w + 2) % 3, v}}) {
            const double at = through[a] + slope * far;
            // Functions are of whole octants.
            if (at < 0 || at >= static_cast<double>((n[a] - 1) / 4 * 4)) {
                return false;
            }
        }
    }
    return true;
}

// Lines of all directions through a part's blocks: none gathers less in the whole than its direction's code
// says.
void expect_below_every_line(const shear::BrickVolume& whole, const shear::BrickVolume& volume,
                             const view::TransferFunction& tf, int side, int lines, unsigned seed,
                             bool octants = false) {
    base::Workers workers(2);
    const Index3 n = volume.cube();
    const BlockGrid grid(n);
    const DirectionGrid directions(side);
    const Block all(whole, tf, whole.box());
    const LeastExtinctions extinctions(all.table, volume.mapping().bits, 1);
    const Cells cells_of =
        octants ? cells_of_octants(volume, extinctions) : cells_of_nodes(volume, 0, extinctions);
    const FunctionTable table = column_functions(cells_of, grid, volume.box(), directions, workers);
    ASSERT_EQ(table.codes.size(), table.block_count() * static_cast<std::size_t>(directions.cells()));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> slope(-1, 1), share(0, 1);
    std::vector<int> cells;
    int opaque = 0;
    for (int line = 0; line < lines; ++line) {
        const int axis = line % 3;
        const auto w = static_cast<std::size_t>(axis);
        const double u = slope(random), v = slope(random);
        Index3 at;
        for (std::size_t a = 0; a < 3; ++a) {
            at[a] = table.blocks.lo[a] +
                    static_cast<std::int64_t>(share(random) *
                                              static_cast<double>(table.blocks.hi[a] - table.blocks.lo[a]));
        }
        const Box block = grid.box(at);
        std::array<double, 3> through;
        for (std::size_t a = 0; a < 3; ++a) {
            // Only where the sub-volume has it.
            const auto lo = static_cast<double>(std::max(block.lo[a], volume.box().lo[a]));
            const auto hi = static_cast<double>(std::min(block.hi[a], volume.box().hi[a]));
            through[a] = lo + share(random) * (hi - lo);
        }
        through[w] = static_cast<double>(block.lo[w]) + static_cast<double>(grid.edge()) / 2;
        directions.cells_of(axis, {{u, u}, {v, v}}, cells);
        const std::size_t index = static_cast<std::size_t>(
            ((at[2] - table.blocks.lo[2]) * table.blocks.cells(1) + at[1] - table.blocks.lo[1]) *
                table.blocks.cells(0) +
            at[0] - table.blocks.lo[0]);
        int code = most_code;
        for (const int cell : cells) {
            code = std::min<int>(code,
                                 table.codes[static_cast<std::size_t>(cell) * table.block_count() + index]);
        }
        opaque += code > 0 ? 1 : 0;
        if (!stays_inside(block, axis, u, v, through, n)) {
            continue;
        }
        for (const int per_cell : {1, 2}) {
            const double depth = depth_along(all, block, axis, u, v, through, per_cell, n);
            EXPECT_GE(depth * (1 + 1e-6), rate_of(code) * static_cast<double>(block.cells(axis)))
                << axis << ": " << u << ", " << v << " by " << per_cell;
        }
    }
    EXPECT_GT(opaque, octants ? 0 : lines / 20);
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
                for (const auto& tf : {ramp(0.2, 0.02, 0.9, 0.3), ramp(0.1, 0.4, 0.5, 0.05)}) {
                    expect_below_every_line(whole, volume, tf, 12, 300, ++seed);
                    expect_below_every_line(whole, volume, tf, 12, 300, ++seed, true);
                }
            }
        }
    }
    const auto volume = test::bricks_of(waves, workers);
    expect_below_every_line(volume, volume, ramp(0.1, 0.01, 0.9, 0.5), 36, 3000, 77);
    expect_below_every_line(volume, volume, ramp(0.1, 0.01, 0.9, 0.5), 36, 3000, 78, true);
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
    const LeastExtinctions extinctions(all.table, 8, 1);
    const auto table =
        column_functions(cells_of_nodes(volume, 0, extinctions), grid, volume.box(), directions, workers);
    const auto rate_along = [&](int axis, double u, double v) {
        std::vector<int> cells;
        directions.cells_of(axis, {{u, u}, {v, v}}, cells);
        return rate_of(table.codes[static_cast<std::size_t>(cells.at(0)) * 27 + grid.index({1, 1, 1})]);
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
        const LeastExtinctions extinctions(all.table, 8, 1);
        const auto table = column_functions(cells_of_nodes(volume, 0, extinctions), BlockGrid(cube.n()),
                                            volume.box(), DirectionGrid(36), workers);
        for (std::size_t cell = 0; cell < 648; ++cell) {
            const double rate = rate_of(table.codes[cell * 27 + 13]);  // of the innermost block
            EXPECT_LE(rate, -std::log1p(-opacity));
            EXPECT_GE(rate, 0.9 * -std::log1p(-opacity));
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
        const ColumnSheaf sheaf(*slopes, first, layers, 16, n % 2 == 0 ? 0.5 : 1);
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
