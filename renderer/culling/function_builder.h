#pragma once
// Opacity functions of blocks (POF 3.1, OPOF 4): for each cell of directions a rate that no line of them
// falls below, taken over the samples that it has in the block. Whatever a ray's thickness D in the block is,
// its optical depth there is at least the rate times D.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "common/base/workers.h"
#include "common/culling/block_grid.h"
#include "common/culling/direction_grid.h"
#include "common/culling/function_table.h"
#include "renderer/culling/block_cells.h"
#include "renderer/culling/sheaf.h"

namespace shearwater::culling {

class FunctionBuilder {
  public:
    explicit FunctionBuilder(const DirectionGrid& grid) : grid_(grid) {}

    const DirectionGrid& grid() const { return grid_; }

    // The codes (rates.h) of all cells of the grid.
    void build(const BlockCells& cells, std::span<std::uint8_t> codes);

  private:
    using Sheaves = std::vector<std::optional<Sheaf>>;  // of each direction and axis

    const Sheaves& sheaves_of(const std::array<int, 3>& counts);
    std::uint8_t greatest_certain(const Layers& layers, const Sheaf& sheaf, int guess, int most);

    DirectionGrid grid_;
    std::map<std::array<int, 3>, Sheaves> sheaves_;
    Certifier certifier_;
};

// Of all blocks that a sub-volume has a part of. Empty if stopped before.
FunctionTable block_functions(const Cells& cells, const BlockGrid& grid, const volume::Box& box,
                              const DirectionGrid& directions, base::Workers& workers,
                              const std::stop_token& stop = {});

}  // namespace shearwater::culling
