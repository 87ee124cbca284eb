#pragma once
// The opacity functions of a cube's blocks that there are so far, and what they say of a transfer function.

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "common/culling/block_grid.h"
#include "common/culling/family.h"
#include "common/culling/function_table.h"
#include "common/culling/visible_blocks.h"

namespace shearwater::culling {

// What a table is of: a basis, on a level of detail.
struct FunctionKey {
    Footprint footprint = Footprint::column;
    Basis basis;
    int level = 0;
    bool operator==(const FunctionKey&) const = default;
};

class FunctionStore {
  public:
    FunctionStore(const BlockGrid& grid, const DirectionGrid& directions);

    const BlockGrid& grid() const { return grid_; }

    // A table of the whole grid; in the place of one that was there.
    void put(const FunctionKey& key, std::shared_ptr<const FunctionTable> table);
    void erase(const FunctionKey& key);
    // None where there is none.
    const FunctionTable* find(const FunctionKey& key) const;

    // Of a transfer function on a level, of each footprint that a kind goes by, by what is there now: a
    // member without a table has no opacity. `distance` is the smallest of two voxels in the world. They last
    // until the next put(), erase() or rates().
    std::vector<BlockRates> rates(const view::TransferFunction& tf, Kind kind, int level, double distance);

  private:
    struct Kept {
        FunctionKey key;
        std::shared_ptr<const FunctionTable> table;
        std::uint8_t greatest;  // of its codes
    };
    struct Scaled {
        const FunctionTable* table;
        std::array<float, 256> rate;  // of a code, at the member's height
    };
    struct Asked {
        view::TransferFunction tf;
        Kind kind;
        int level;
        double distance;
        bool operator==(const Asked&) const = default;
    };
    struct Combined {
        Footprint footprint;
        float most;      // of a combined code
        float greatest;  // that there is
        std::vector<Scaled> scaled;
        Combination combination;
        std::vector<std::uint8_t> of_pairs = {};           // where there are two tables, of any two codes
        std::map<int, std::vector<std::uint8_t>> of = {};  // where there are more, by direction cell
    };

    const Kept* kept(const FunctionKey& key) const;
    Combined combined(Footprint footprint) const;
    std::vector<BlockCodes> codes_of(Combined& combined, std::span<const int> cells,
                                     base::Workers& workers) const;
    void combine(const Combined& combined, int cell, std::span<std::uint8_t> codes) const;
    static void combine_pairs(Combined& combined, base::Workers& workers);

    BlockGrid grid_;
    DirectionGrid directions_;
    std::vector<Kept> tables_;
    std::optional<Asked> asked_;  // last, and what came of it:
    std::vector<Combined> combined_;
};

}  // namespace shearwater::culling
