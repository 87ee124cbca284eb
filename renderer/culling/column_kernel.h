#pragma once
// The inner loop of column functions: the least that any line of a sheaf gathers, over all bundles through a
// block's cells half-way.

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/culling/direction_grid.h"
#include "renderer/culling/reach.h"

namespace shearwater::culling {

// The layers between a block's planes along an axis, the first of them, and those of them that are there.
struct ColumnSheaf {
    static constexpr int max_layers = 32;
    // No line goes farther sideways than this.
    static constexpr int farthest = 19;

    int first_layer = 0, layers = 0;
    std::array<Reach, max_layers> u{}, v{};

    // Lines half-way at the layer `middle`, which need not be one of them.
    ColumnSheaf(const Slopes& slopes, int first, int count, double middle);
};

// Extinctions in units, a row of cells along u after the other; so many on every side of
// the block's may be read, and a vector beyond.
struct ColumnCells {
    const std::uint16_t* first;  // the block's first cell on the sheaf's first layer
    std::ptrdiff_t row, layer;   // strides
    int bundles_u, bundles_v;    // the block's cells, at most 32 each
};
inline constexpr int column_padding = 64;

// In units, at most 65535.
std::uint16_t least_depth(const ColumnCells& cells, const ColumnSheaf& sheaf);
// Its definition, bundle after bundle.
std::uint16_t least_depth_by_definition(const ColumnCells& cells, const ColumnSheaf& sheaf);

}  // namespace shearwater::culling
