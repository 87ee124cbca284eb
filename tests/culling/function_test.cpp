#include "renderer/culling/function_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "common/culling/rates.h"
#include "tests/culling/block.h"
#include "tests/support/reference_cubes.h"

namespace shearwater::culling {
namespace {

using volume::Box;
using volume::Index3;

// The mean extinction of a line's samples on planes 1 / `per_cell` apart along its axis that the block owns,
// or of its segments between those planes that lie in the block; none where it has none.
std::optional<double> mean_along(const Block& block, int axis, double u, double v,
                                 const std::array<double, 3>& through, int per_cell, bool segments) {
    const auto w = static_cast<std::size_t>(axis);
    const auto on_plane = [&](std::int64_t n) {
        const double at = static_cast<double>(n) / per_cell;
        std::array<double, 3> p = through;
        p[w] = at;
        p[(w + 1) % 3] += u * (at - through[w]);
        p[(w + 2) % 3] += v * (at - through[w]);
        return p;
    };
    double sum = 0;
    int count = 0;
    for (std::int64_t n = block.box.lo[w] * per_cell; n < block.box.hi[w] * per_cell; ++n) {
        const auto p = on_plane(n), q = on_plane(n + 1);
        auto inside = q;
        inside[w] = p[w];  // what ends on the block's last plane lies in it
        if (block.owns(p) && (!segments || block.owns(inside))) {
            sum += segments ? block.extinction(p, q) : block.extinction(p);
            ++count;
        }
    }
    return count > 0 ? std::optional(sum / count) : std::nullopt;
}

// No line of any direction through the block has less in the mean than its direction's code says.
void expect_below_every_line(const Block& block, int side, int lines, unsigned seed) {
    FunctionBuilder builder{DirectionGrid(side)};
    std::vector<std::uint8_t> codes(static_cast<std::size_t>(builder.grid().cells()));
    builder.build(block.cells(), codes);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> slope(-1, 1), share(-0.2, 1.2);
    std::vector<int> cells;
    int met = 0;
    for (int n = 0; n < lines; ++n) {
        const int axis = n % 3;
        const double u = slope(random), v = slope(random);
        std::array<double, 3> through;
        for (std::size_t a = 0; a < 3; ++a) {
            through[a] = static_cast<double>(block.box.lo[a]) +
                         share(random) * static_cast<double>(block.box.hi[a] - block.box.lo[a]);
        }
        builder.grid().cells_of(axis, {{u, u}, {v, v}}, cells);
        for (const auto& [per_cell, segments] : {std::pair{1, false}, {2, false}, {1, true}, {2, true}}) {
            if (const auto mean = mean_along(block, axis, u, v, through, per_cell, segments)) {
                ++met;
                const int code = *std::min_element(codes.begin(), codes.end());
                double rate = block.least_of(code);
                for (const int cell : cells) {
                    rate = std::max(rate, block.least_of(codes[static_cast<std::size_t>(cell)]));
                }
                EXPECT_GE(*mean * (1 + 1e-6), cells.size() == 1 ? rate : block.least_of(code))
                    << axis << ": " << u << ", " << v << " by " << per_cell << (segments ? " segments" : "");
            }
        }
    }
    EXPECT_GT(met, lines / 2);
}

TEST(OpacityFunction, IsBelowEveryLine) {
    base::Workers workers(1);
    test::FloatCube noise = test::noise_cube({40, 40, 40});
    test::FloatCube waves = shells({40, 40, 40});
    test::FloatCube spotted = test::noise_cube({40, 40, 40}, 3);
    for (std::size_t i = 0; i < spotted.values().size(); i += 97) {
        spotted.values()[i] = std::numeric_limits<float>::quiet_NaN();
    }
    unsigned seed = 0;
    for (test::FloatCube* cube : {&noise, &waves, &spotted}) {
        for (const int bits : {8, 16}) {
            const auto volume = test::bricks_of(*cube, workers, {.bits = bits});
            for (const auto& tf : {ramp(0.2, 0.02, 0.9, 0.3), ramp(0.3, 0, 0.6, 0.9),
                                   ramp(0.1, 0.4, 0.5, 0.05), step(0.3, 0.02, 0.3)}) {
                for (const Box& box : {Box{{0, 0, 0}, {32, 32, 32}}, Box{{32, 16, 3}, {39, 33, 35}}}) {
                    expect_below_every_line(Block(volume, tf, box), 12, 300, ++seed);
                }
            }
        }
    }
}

TEST(OpacityFunction, IsBelowEveryLineInNarrowCells) {
    base::Workers workers(1);
    test::FloatCube waves = shells({34, 34, 34});
    const auto volume = test::bricks_of(waves, workers);
    expect_below_every_line(Block(volume, ramp(0.1, 0.01, 0.9, 0.5), {{0, 0, 0}, {32, 32, 32}}), 36, 3000, 7);
    // A segment counts as a whole, though it may have its other end in another cell.
    test::FloatCube steep({34, 34, 34}, [](double x, double y, double) {
        return static_cast<float>(0.5 + 0.02 * std::sin(1.3 * (x + y)));
    });
    const auto nearly_even = test::bricks_of(steep, workers, {.bits = 16});
    expect_below_every_line(Block(nearly_even, step(0.5, 0.02, 0.3), {{0, 0, 0}, {32, 32, 32}}), 36, 3000, 8);
}

// Lines that leave the cube within a cell have no sample in the rest of it.
TEST(OpacityFunction, IsBelowEveryLineWhereTheCubeEndsWithinACell) {
    base::Workers workers(1);
    test::FloatCube noise = test::noise_cube({72, 72, 72});
    test::FloatCube waves = shells({72, 72, 72});
    unsigned seed = 50;
    for (test::FloatCube* cube : {&noise, &waves}) {
        const auto volume = test::bricks_of(*cube, workers);
        for (const Box& box : {Box{{16, 16, 16}, {36, 36, 36}}, Box{{0, 32, 16}, {16, 36, 32}}}) {
            const Block block(volume, ramp(0.3, 0, 0.6, 0.9), box, 1);
            EXPECT_EQ(block.cells().whole[1], block.cells().counts[1] - 1);
            expect_below_every_line(block, 12, 3000, ++seed);
        }
    }
}

// Of a homogeneous block it is what the block has, in every direction.
TEST(OpacityFunction, IsExactForAHomogeneousBlock) {
    base::Workers workers(1);
    test::FloatCube cube({40, 40, 40}, [](double, double, double) { return 0.5F; });
    const auto volume = test::bricks_of(cube, workers);
    for (const double opacity : {0.003, 0.05, 0.3}) {
        const Block block(volume, ramp(0, opacity, 1, opacity), {{0, 0, 0}, {32, 32, 32}});
        FunctionBuilder builder{DirectionGrid(36)};
        std::vector<std::uint8_t> codes(648);
        builder.build(block.cells(), codes);
        for (const std::uint8_t code : codes) {
            EXPECT_LE(block.least_of(code), -std::log1p(-opacity));
            EXPECT_GE(block.least_of(code), 0.9 * -std::log1p(-opacity));
        }
    }
}

// Of all that lies between two codes: samples, and segments however short.
TEST(LeastExtinctions, AreBelowSamplesAndSegments) {
    base::Workers workers(1);
    test::FloatCube cube = test::noise_cube({4, 4, 4});
    std::mt19937 random(9);
    std::uniform_real_distribution<double> share(0, 1);
    for (const int bits : {8, 16}) {
        const auto volume = test::bricks_of(cube, workers, {.bits = bits});
        const int levels = volume.mapping().levels();
        for (int trial = 0; trial < 40; ++trial) {
            // A hole between codes, or a ramp.
            const double hole = share(random);
            const view::TransferFunction tf =
                trial % 2 == 0 ? view::TransferFunction{{view::Flat{1}, view::Blank{hole, hole + 0.001}},
                                                        {{0, {1, 1, 1}}},
                                                        {}}
                               : ramp(hole, 0.9 * share(random), 1, 0.5 * share(random));
            const Block block(volume, at_height(members_of(tf).at(0).basis, 2 * least_height), volume.box());
            const LeastExtinctions least = block.extinctions();
            for (int n = 0; n < 400; ++n) {
                const int min = 1 + static_cast<int>(share(random) * (levels - 20)), max = min + n % 20;
                const double bound =
                    least.between(static_cast<std::uint16_t>(min), static_cast<std::uint16_t>(max)) *
                    value_unit * 2 * least_height;
                const double from = min + share(random) * (max - min), to = min + share(random) * (max - min);
                EXPECT_LE(bound, block.sample_extinction(from)) << min << ", " << max;
                for (const double end : {to, from, from + 0.01 * (to - from)}) {
                    EXPECT_LE(bound, block.segment_extinction(from, end)) << min << ", " << max;
                }
            }
        }
    }
}

std::int16_t greatest_by_definition(const Layers& layers, const Sheaf& sheaf) {
    int certain = 0, uncertain = most_units + 1;
    while (uncertain - certain > 1) {
        const std::array tried{static_cast<std::int16_t>((certain + uncertain) / 2)};
        (first_certain_by_definition(layers, sheaf, tried) == 0 ? certain : uncertain) = tried[0];
    }
    return static_cast<std::int16_t>(certain);
}

TEST(Certifier, IsItsDefinition) {
    base::Workers workers(1);
    std::mt19937 random(3);
    Certifier certifier;
    const DirectionGrid grid(12);
    for (const Index3& counts : {Index3{32, 32, 32}, Index3{5, 32, 17}, Index3{1, 2, 3}}) {
        test::FloatCube cube = test::noise_cube({counts[0] + 1, counts[1] + 1, counts[2] + 1});
        const auto volume = test::bricks_of(cube, workers);
        const Block block(volume, ramp(0.1, 0, 0.9, 0.3), volume.box());
        BlockCells cells = block.cells();
        for (std::int16_t& units : cells.units) {
            units = static_cast<std::int16_t>(200 + random() % 1000);
        }
        for (int n = 0; n < 40; ++n) {
            for (std::size_t a = 0; a < 3; ++a) {
                cells.whole[a] = cells.counts[a] - static_cast<int>(random() % 2);
            }
            const int cell = static_cast<int>(random() % static_cast<unsigned>(grid.cells()));
            for (int axis = 0; axis < 3; ++axis) {
                if (const auto slopes = grid.slopes(cell, axis)) {
                    const Layers layers(cells, axis);
                    const Sheaf sheaf(axis, *slopes, cells.counts);
                    const auto top = static_cast<std::int16_t>(200 + random() % 400);
                    std::vector<std::int16_t> tried;
                    for (int i = 0; i < 1 + n % 4; ++i) {
                        tried.push_back(static_cast<std::int16_t>(top * (4 - i) / 4));
                    }
                    ASSERT_EQ(certifier.first_certain(layers, sheaf, tried),
                              first_certain_by_definition(layers, sheaf, tried));
                    const std::int16_t greatest = greatest_by_definition(layers, sheaf);
                    const std::array at_the_edge{static_cast<std::int16_t>(greatest + 1), greatest};
                    ASSERT_EQ(certifier.first_certain(layers, sheaf, at_the_edge), 1);
                }
            }
        }
    }
}

TEST(Rates, AreRoundedDown) {
    EXPECT_EQ(rate_of(0), 0);
    EXPECT_EQ(rate_of(255), greatest_rate);
    for (int code = 1; code < 255; ++code) {
        EXPECT_LT(rate_of(code), rate_of(code + 1));
        EXPECT_EQ(code_below(rate_of(code) * (1 + 1e-12)), code);
        EXPECT_EQ(code_below(rate_of(code) * (1 - 1e-12)), code - 1);
    }
    EXPECT_EQ(code_below(1e9), 255);
    EXPECT_EQ(code_below(0), 0);
}

}  // namespace
}  // namespace shearwater::culling
