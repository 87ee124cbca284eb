#pragma once
// All lines through a block whose slopes lie in given intervals, and what can be said of every one of them.
//
// They are taken in bundles: those that pass through one cell (i, j) of the plane half-way through the block.
// In a layer of cells along the principal axis w a bundle's lines lie within a few cells,
//
//   layer 0    [. .|. . .]. .        from i + u[0].first to i + u[0].last along u, and likewise along v;
//   middle     . . .[.]. . . .       some of which may be outside the block. A bundle wholly inside has a
//   last       . . .[. . .|. .]      sample there on every line, one partly inside perhaps, and one in a cell
//                                    that the cube's end cuts off.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/culling/direction_grid.h"
#include "renderer/culling/block_cells.h"
#include "renderer/culling/reach.h"

namespace shearwater::culling {

struct Sheaf {
    int axis = 2;    // w; u = (axis + 1) % 3, v = (axis + 2) % 3
    int layers = 0;  // counts[axis]
    std::array<Reach, BlockCells::max_edge> u{}, v{};
    Reach bundles_u{}, bundles_v{};  // of those that meet the block

    Sheaf(int along, const Slopes& slopes, const std::array<int, 3>& counts);
};

// A block's cells layer by layer along an axis: cell (u, v) of layer w at units[(w * counts_v + v) * counts_u
// + u].
struct Layers {
    int counts_u, counts_v;
    int whole_u, whole_v;  // of them, from the first on
    std::vector<std::int16_t> units;

    Layers(const BlockCells& cells, int axis);
};

// How much room a bundle search needs; kept from one to the next.
class Certifier {
  public:
    // The first of some extinctions, in units and falling, that every line of the sheaf has in the mean, over
    // whichever of its samples lie in the block; -1 where none of them is. The first and the last layer may
    // count less than the others: a ray that enters the cube there stands for less than a step.
    int first_certain(const Layers& cells, const Sheaf& sheaf, std::span<const std::int16_t> extinctions);

    // At most so many at a time.
    static constexpr std::size_t max_extinctions = 4;

  private:
    std::vector<std::int16_t> row_, eroded_, excess_;
};

// Its definition, bundle after bundle.
int first_certain_by_definition(const Layers& cells, const Sheaf& sheaf,
                                std::span<const std::int16_t> extinctions);

}  // namespace shearwater::culling
