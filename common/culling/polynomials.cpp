#include "common/culling/polynomials.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/check.h"
#include "common/culling/rates.h"

namespace shearwater::culling {

namespace {

constexpr std::size_t count = polynomial_terms;
using Matrix = std::array<std::array<double, count>, count>;

// By Gauss and Jordan, with the largest pivot of a column.
Matrix inverse(Matrix of) {
    Matrix result{};
    for (std::size_t n = 0; n < count; ++n) {
        result[n][n] = 1;
    }
    for (std::size_t column = 0; column < count; ++column) {
        std::size_t pivot = column;
        for (std::size_t row = column; row < count; ++row) {
            pivot = std::abs(of[row][column]) > std::abs(of[pivot][column]) ? row : pivot;
        }
        base::check(std::abs(of[pivot][column]) > 1e-12, "a direction grid's cells tell ten terms apart");
        std::swap(of[pivot], of[column]);
        std::swap(result[pivot], result[column]);
        const double scale = 1 / of[column][column];
        for (std::size_t n = 0; n < count; ++n) {
            of[column][n] *= scale;
            result[column][n] *= scale;
        }
        for (std::size_t row = 0; row < count; ++row) {
            const double times = row == column ? 0 : of[row][column];
            for (std::size_t n = 0; n < count; ++n) {
                of[row][n] -= times * of[column][n];
                result[row][n] -= times * result[column][n];
            }
        }
    }
    return result;
}

}  // namespace

PolynomialFit::PolynomialFit(const DirectionGrid& directions) {
    const int side = directions.side();
    base::check(side >= 8, "a direction grid has at least four cells along phi");
    Matrix squares{};
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side / 2; ++j) {
            const double t = (2 * i + 1.0) / side - 1, p = (4 * j + 2.0) / side - 1;  // -1 to 1
            terms_.push_back({1, t, p, t * t, t * p, p * p, t * t * t, t * t * p, t * p * p, p * p * p});
            for (std::size_t a = 0; a < count; ++a) {
                for (std::size_t b = 0; b < count; ++b) {
                    squares[a][b] += terms_.back()[a] * terms_.back()[b];
                }
            }
        }
    }
    const Matrix inverted = inverse(squares);
    for (const Terms& terms : terms_) {
        Terms& weights = weights_.emplace_back();
        for (std::size_t a = 0; a < count; ++a) {
            for (std::size_t b = 0; b < count; ++b) {
                weights[a] += inverted[a][b] * terms[b];
            }
        }
    }
}

double PolynomialFit::value(const Polynomial& polynomial, std::size_t cell) const {
    double value = 0;
    for (std::size_t n = 0; n < count; ++n) {
        value += static_cast<double>(polynomial[n]) * terms_[cell][n];
    }
    return value;
}

std::uint8_t PolynomialFit::code(const Polynomial& polynomial, int cell) const {
    const double code = std::floor(value(polynomial, static_cast<std::size_t>(cell)));
    return static_cast<std::uint8_t>(std::clamp(code, 0.0, static_cast<double>(most_code)));
}

Polynomial PolynomialFit::fit(std::span<const std::uint8_t> codes) const {
    base::check(codes.size() == terms_.size(), "a code for each direction");
    Terms sums{};
    for (std::size_t cell = 0; cell < codes.size(); ++cell) {
        for (std::size_t n = 0; n < count; ++n) {
            sums[n] += weights_[cell][n] * codes[cell];
        }
    }
    Polynomial polynomial;
    std::transform(sums.begin(), sums.end(), polynomial.begin(),
                   [](double sum) { return static_cast<float>(sum); });
    // A code is rounded down: the polynomial may be above it, by less than a step.
    constexpr double below_a_step = 1 - 1.0 / 64;
    double over = -1e9;
    for (std::size_t cell = 0; cell < codes.size(); ++cell) {
        over = std::max(over, value(polynomial, cell) - codes[cell] - below_a_step);
    }
    polynomial[0] = static_cast<float>(static_cast<double>(polynomial[0]) - over);
    return polynomial;
}

std::vector<Polynomial> polynomials_of(const FunctionTable& table) {
    const DirectionGrid directions(table.side);
    const PolynomialFit fit(directions);
    const std::size_t blocks = table.block_count();
    std::vector<Polynomial> polynomials;
    std::vector<std::uint8_t> codes(static_cast<std::size_t>(directions.cells()));
    for (std::size_t block = 0; block < blocks; ++block) {
        for (std::size_t cell = 0; cell < codes.size(); ++cell) {
            codes[cell] = table.codes[cell * blocks + block];
        }
        polynomials.push_back(fit.fit(codes));
    }
    return polynomials;
}

FunctionTable table_of(const std::vector<Polynomial>& polynomials, const volume::Box& blocks, int side) {
    const DirectionGrid directions(side);
    const PolynomialFit fit(directions);
    FunctionTable table{.blocks = blocks, .side = side, .codes = {}};
    for (int cell = 0; cell < directions.cells(); ++cell) {
        for (const Polynomial& polynomial : polynomials) {
            table.codes.push_back(fit.code(polynomial, cell));
        }
    }
    return table;
}

}  // namespace shearwater::culling
