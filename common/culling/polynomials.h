#pragma once
// Opacity functions as polynomials (POF 3.1, 5): of third order in theta and phi, ten coefficients and 40
// bytes a block instead of one byte a direction's cell. A fit of least squares to the block's codes, which
// are logarithms of its rates, lowered until it is nowhere above them: so it says less than the table, and is
// as much a lower bound.
//
// A function is asked for a cell, not for an angle in it, and half of the directions stand for all. So the
// polynomial is one of a cell's two numbers over the half sphere, and has no seam to be continuous across.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/culling/direction_grid.h"
#include "common/culling/function_table.h"

namespace shearwater::culling {

inline constexpr int polynomial_terms = 10;
using Polynomial = std::array<float, polynomial_terms>;

class PolynomialFit {
  public:
    explicit PolynomialFit(const DirectionGrid& directions);

    // To the codes of a block, one a direction's cell.
    Polynomial fit(std::span<const std::uint8_t> codes) const;
    // What it says of a cell: no more than the codes that it was fitted to.
    std::uint8_t code(const Polynomial& polynomial, int cell) const;

  private:
    using Terms = std::array<double, polynomial_terms>;

    double value(const Polynomial& polynomial, std::size_t cell) const;

    std::vector<Terms> terms_;    // of each cell
    std::vector<Terms> weights_;  // of its code in each coefficient
};

// Of each block of a table, in its order.
std::vector<Polynomial> polynomials_of(const FunctionTable& table);
// And a table of what those say of the same blocks.
FunctionTable table_of(const std::vector<Polynomial>& polynomials, const volume::Box& blocks, int side);

}  // namespace shearwater::culling
