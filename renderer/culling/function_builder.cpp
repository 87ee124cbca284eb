#include "renderer/culling/function_builder.h"

#include <algorithm>
#include <array>

#include "common/base/check.h"
#include "common/culling/rates.h"

namespace shearwater::culling {

namespace {

// In units, rounded up: what is certain of it is certain of the code's rate.
std::int16_t units_of(int code) {
    return static_cast<std::int16_t>(std::ceil(rate_of(code) / value_unit));
}

}  // namespace

const FunctionBuilder::Sheaves& FunctionBuilder::sheaves_of(const std::array<int, 3>& counts) {
    Sheaves& sheaves = sheaves_[counts];
    if (sheaves.empty()) {
        for (int cell = 0; cell < grid_.cells(); ++cell) {
            for (int axis = 0; axis < 3; ++axis) {
                const auto slopes = grid_.slopes(cell, axis);
                sheaves.push_back(slopes ? std::optional(Sheaf(axis, *slopes, counts)) : std::nullopt);
            }
        }
    }
    return sheaves;
}

// The greatest code up to `most` that is certain: near the guess at first, then ever farther from it.
std::uint8_t FunctionBuilder::greatest_certain(const Layers& layers, const Sheaf& sheaf, int guess,
                                               int most) {
    int certain = 0, uncertain = most + 1;  // codes
    int step = 1;
    int at = std::clamp(guess, 1, most);
    while (uncertain - certain > 1) {
        // Falling; around `at` as long as neither end is near, else spread over what is left.
        std::array<std::int16_t, Certifier::max_extinctions> units;
        std::array<int, Certifier::max_extinctions> tried;
        std::size_t count = 0;
        for (int n = 1; n >= -2; --n) {
            const int code = std::clamp(at + n * step, certain + 1, uncertain - 1);
            if (count == 0 || code < tried[count - 1]) {
                tried[count] = code;
                units[count++] = units_of(code);
            }
        }
        const int found = certifier_.first_certain(layers, sheaf, std::span(units).first(count));
        if (found < 0) {
            uncertain = tried[count - 1];
            at = uncertain - 2 * step;
        } else {
            certain = tried[static_cast<std::size_t>(found)];
            if (found > 0) {
                uncertain = tried[static_cast<std::size_t>(found) - 1];
            }
            at = found > 0 ? (certain + uncertain) / 2 : certain + 3 * step;
        }
        step = certain > 0 && uncertain <= most ? std::max((uncertain - certain) / 5, 1) : 3 * step;
    }
    return static_cast<std::uint8_t>(certain);
}

void FunctionBuilder::build(const BlockCells& cells, std::span<std::uint8_t> codes) {
    base::check(codes.size() == static_cast<std::size_t>(grid_.cells()), "a code for each direction");
    const int least = code_below(cells.least * value_unit);
    const int most = code_below(cells.greatest * value_unit);
    if (least == most) {
        std::fill(codes.begin(), codes.end(), static_cast<std::uint8_t>(least));
        return;
    }
    const Sheaves& sheaves = sheaves_of(cells.counts);
    const std::array layers{Layers(cells, 0), Layers(cells, 1), Layers(cells, 2)};
    int guess = least;
    for (std::size_t cell = 0; cell < codes.size(); ++cell) {
        int code = most;
        for (std::size_t axis = 0; axis < 3 && code > least; ++axis) {
            const auto& sheaf = sheaves[3 * cell + axis];
            if (sheaf) {
                code = greatest_certain(layers[axis], *sheaf, guess, code);
            }
        }
        codes[cell] = static_cast<std::uint8_t>(std::max(code, least));
        guess = codes[cell];
    }
}

FunctionTable block_functions(const Cells& cells, const BlockGrid& grid, const volume::Box& box,
                              const DirectionGrid& directions, base::Workers& workers,
                              const std::stop_token& stop) {
    FunctionTable table{.blocks = grid.blocks_of(box), .side = directions.side(), .codes = {}};
    const std::size_t count = table.block_count();
    const auto sides = static_cast<std::size_t>(directions.cells());
    table.codes.assign(count * sides, 0);
    const std::int64_t edge = grid.edge() / cells.grid.edge;
    const volume::Index3 counts{table.blocks.cells(0), table.blocks.cells(1), table.blocks.cells(2)};
    const bool all = workers.for_each(
        counts[1] * counts[2],
        [&](std::int64_t row) {
            FunctionBuilder builder(directions);
            std::vector<std::uint8_t> codes(sides);
            for (std::int64_t x = 0; x < counts[0]; ++x) {
                const volume::Index3 at{x, row % counts[1], row / counts[1]};
                volume::Box block;
                bool any = edge > 0;
                for (std::size_t a = 0; a < 3; ++a) {
                    block.lo[a] = std::max((table.blocks.lo[a] + at[a]) * edge, cells.box.lo[a]);
                    block.hi[a] = std::min((table.blocks.lo[a] + at[a] + 1) * edge, cells.box.hi[a]);
                    any = any && block.lo[a] < block.hi[a];
                }
                if (any) {
                    builder.build(BlockCells(cells, block), codes);
                    for (std::size_t side = 0; side < sides; ++side) {
                        table.codes[side * count + static_cast<std::size_t>(row * counts[0] + x)] =
                            codes[side];
                    }
                }
            }
        },
        stop);
    return all ? table : FunctionTable{};
}

}  // namespace shearwater::culling
