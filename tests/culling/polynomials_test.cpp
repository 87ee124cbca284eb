// Opacity functions as polynomials: never more than the table that they are fitted to.

#include "common/culling/polynomials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace shearwater::culling {
namespace {

TEST(Polynomials, AreBelowTheTable) {
    std::mt19937 random(1);
    for (const int side : {8, 12, 36}) {
        const DirectionGrid directions(side);
        FunctionTable table{.blocks = {{0, 0, 0}, {20, 1, 1}}, .side = side, .codes = {}};
        for (int cell = 0; cell < directions.cells(); ++cell) {
            const int i = cell / (side / 2), j = cell % (side / 2);
            for (int block = 0; block < 20; ++block) {
                // Noise, waves, steps, single directions that are clear, and all alike.
                const double kinds[]{static_cast<double>(random() % 256),
                                     128 + 120 * std::sin(i * 0.4 + block) * std::cos(j * 0.5),
                                     i < side / 2 ? 250.0 : 3.0, cell == block ? 0.0 : 255.0, 13.0 * block};
                table.codes.push_back(static_cast<std::uint8_t>(kinds[block % 5]));
            }
        }
        const std::vector<Polynomial> polynomials = polynomials_of(table);
        static_assert(sizeof(Polynomial) == 40);
        const FunctionTable said = table_of(polynomials, table.blocks, side);
        ASSERT_EQ(said.codes.size(), table.codes.size());
        for (std::size_t n = 0; n < said.codes.size(); ++n) {
            ASSERT_LE(said.codes[n], table.codes[n]) << n;
        }
    }
}

// What is of third order comes back, but for what codes are rounded by; what is all alike exactly.
TEST(Polynomials, FitWhatIsAPolynomial) {
    constexpr int side = 36;
    const DirectionGrid directions(side);
    const PolynomialFit fit(directions);
    std::vector<std::uint8_t> codes;
    for (int cell = 0; cell < directions.cells(); ++cell) {
        const double t = (2.0 * (cell / (side / 2)) + 1) / side - 1;
        const double p = (4.0 * (cell % (side / 2)) + 2) / side - 1;
        codes.push_back(
            static_cast<std::uint8_t>(130 + 40 * t - 30 * p * p + 20 * t * t * t - 15 * t * p * p));
    }
    const Polynomial polynomial = fit.fit(codes);
    for (int cell = 0; cell < directions.cells(); ++cell) {
        EXPECT_GE(fit.code(polynomial, cell) + 2, codes[static_cast<std::size_t>(cell)]);
    }
    for (const int code : {0, 1, 77, 255}) {
        std::ranges::fill(codes, static_cast<std::uint8_t>(code));
        const Polynomial even = fit.fit(codes);
        for (int cell = 0; cell < directions.cells(); ++cell) {
            ASSERT_EQ(fit.code(even, cell), code);
        }
    }
}

}  // namespace
}  // namespace shearwater::culling
