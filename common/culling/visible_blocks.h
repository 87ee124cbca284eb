#pragma once
// Which blocks a frame's rays may see (POF 3.3), whatever the projection and wherever the eye is.
//
// Each face's image is cut into beams of a few pixels a side. A beam goes front to back through the slabs of
// blocks across the face's principal axis. What it meets of a slab is visible as long as it has light left;
// then it has gathered at least what its directions' functions (rates.h) say of blocks that it passes:
//
//     eye >===  slab 0  |  slab 1  |
//              [a][b]   |[a][b][c] |
//
// rate times thickness of the blocks that it is in half-way through the slab (columns), or of any that it
// meets there (blocks); of either the least of several, along the shortest of its rays. opof takes the more
// of both. The others have blocks alone: pof one sample's depth, and opof-linear that or, if more, the
// greatest thickness' opacity by shares. So what is hidden by pof is by opof-linear, and what is by that is
// by opof.
//
// Every ray of a beam has at least the depth counted when it comes to a block that is not visible, and
// what is left out lies behind that depth, on every ray.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "common/base/workers.h"
#include "common/culling/block_grid.h"
#include "common/culling/direction_grid.h"
#include "common/culling/settings.h"
#include "common/view/factorisation.h"

namespace shearwater::culling {

// A code for each of the grid's blocks: that of a table, or what those of two tables combine to.
class BlockCodes {
  public:
    explicit BlockCodes(std::span<const std::uint8_t> codes) : first_(codes) {}
    // The code of a and b is of_pairs[256 a + b].
    BlockCodes(std::span<const std::uint8_t> first, std::span<const std::uint8_t> second,
               std::span<const std::uint8_t> of_pairs)
        : first_(first), second_(second.data()), of_pairs_(of_pairs.data()) {}

    std::size_t size() const { return first_.size(); }
    bool paired() const { return second_ != nullptr; }
    std::uint8_t operator[](std::size_t block) const { return paired() ? of_pair(block) : alone(block); }
    // The same where it is known which.
    std::uint8_t alone(std::size_t block) const { return first_[block]; }
    std::uint8_t of_pair(std::size_t block) const {
        return of_pairs_[std::size_t{first_[block]} << 8U | second_[block]];
    }

  private:
    std::span<const std::uint8_t> first_;
    const std::uint8_t* second_ = nullptr;
    const std::uint8_t* of_pairs_ = nullptr;
};

// Of functions of one footprint.
struct BlockRates {
    Footprint footprint;
    DirectionGrid directions;
    // Of lines of each of some of the directions' cells. What this gives lasts as long as it does.
    std::function<std::vector<BlockCodes>(std::span<const int> cells, base::Workers& workers)> of;
    // Of a code, rising with it: optical depth along the smallest distance of two voxels.
    std::array<float, 256> rate;
    float greatest;  // no block's is more, in no direction
};

// Which part of the image, of so many that take about as long each and together are all of it.
struct ImagePart {
    int part = 0;
    int parts = 1;
};

// What a part of the image sees; what all parts see together is what all of it sees at once. The rates are of
// the functions that the settings' kind goes by, which is not off, or of some of them. Of a cropped cube only
// blocks that are shown from end to end hide anything. All are visible where no ray could be hidden even if
// every block were as dense as the densest.
BlockSet visible_blocks(const view::Factorisation& factorisation, const BlockGrid& grid,
                        std::span<const BlockRates> rates, const Settings& settings, base::Workers& workers,
                        const ImagePart& part = {});

}  // namespace shearwater::culling
