#pragma once
// What of a level a transfer function shows, where that is little: pieces of a few octants, strewn over the
// cube, with their voxels copied side by side. The volume has the voxels of an octant in 25 lines of the
// cache, which most of the time would go to; here they take two or three.
//
// Pieces lie in half layers of micro-bricks across a face's principal axis, each an octant deep, and in
// columns of whole octants along the fast one:
//
//   fast ->   0        32        64        octants
//   slow  o---+--------+---------+
//    v    |  ###    ## |    ##   |         what is alike in rows that follow one another is one piece
//         |  ### #  ## |    ##   |
//
// Of most octants few cells may be seen: which of a piece is told for each of its planes.

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "common/base/workers.h"
#include "renderer/shear/code_volume.h"
#include "renderer/shear/octant_runs.h"
#include "renderer/shear/plane_cells.h"
#include "renderer/shear/voxel_region.h"

namespace shearwater::shear {

// Octants along a face's fast and slow axes to visit alike.
struct Piece {
    MicroRun fast, slow;
    Visit visit;
};

template <class Code>
class SparsePieces {
  public:
    static constexpr std::int64_t column = 32;     // octants
    static constexpr std::int64_t most_rows = 32;  // of octants of a piece

    // Of the micro-bricks' contents of a level, for faces across an axis. The codes have to outlive
    // it.
    SparsePieces(const CodeVolume& codes, const OpacityTable& table, std::span<const Content> contents,
                 int axis, base::Workers& workers);

    struct Copied {
        Piece piece;
        std::size_t first = 0;  // of its voxels
        // Which of its cells, as find_opaque_cells has them.
        std::array<PlaneCells, 2 * CodeVolume::octant_edge + 1> opaque{};
    };
    // Of a column of a half layer, both counted from the sub-volume's first: rows by rows, and along them.
    std::span<const Copied> in(std::int64_t half_layer, std::int64_t column_number) const {
        const std::size_t n = slot(half_layer) + static_cast<std::size_t>(column_number);
        return std::span(pieces_).subspan(begins_[n], begins_[n + 1] - begins_[n]);
    }
    bool any_in(std::int64_t half_layer) const {
        return begins_[slot(half_layer)] != begins_[slot(half_layer + 1)];
    }
    // Octants of the sub-volume along the fast and the slow axis.
    const std::array<MicroRun, 2>& octants() const { return octants_; }

    // The nodes of the sub-volume's own that a piece of a half layer has, and where they lie, one row and one
    // plane right behind the other.
    VoxelRegion nodes_of(std::int64_t half_layer, const Piece& piece) const;
    VoxelPlace<Code> find(const Copied& copied, const VoxelRegion& nodes) const {
        return {&voxels_[copied.first], nodes.count(0), nodes.count(0) * nodes.count(1)};
    }

  private:
    // Those of a half layer, column by column, and how many each has.
    struct Found {
        std::vector<Copied> pieces;
        std::vector<std::size_t> of_columns;
    };
    using FoundInHalves = std::array<Found, 2>;
    class Adding;
    FoundInHalves found_in(std::int64_t layer, std::span<const Content> contents) const;
    void copy_voxels(std::int64_t half_layer);  // and find which cells may be seen
    std::size_t slot(std::int64_t half_layer) const {
        return static_cast<std::size_t>(half_layer) * columns_;
    }

    const CodeVolume& codes_;
    const OpacityTable::Codes opaque_codes_;
    std::array<int, 3> axes_;  // fast, slow and principal
    std::array<MicroRun, 2> octants_;
    std::size_t columns_;
    std::vector<Copied> pieces_;
    std::vector<std::size_t> begins_;  // of those of each column of each half layer, and the end
    std::vector<Code> voxels_;
};

// Those of a classification, of every level and axis.
class SparseFaces {
  public:
    // Whether so many octants of so many are so few that pieces of them are soon found and copied.
    static bool pay(std::uint64_t opaque, std::uint64_t octants);

    // Found and copied when they are first asked for, which takes less than the volume takes longer to draw.
    template <class Code>
    const SparsePieces<Code>& pieces(const CodeVolume& codes, int level, const OpacityTable& table,
                                     std::span<const Content> contents, int axis, base::Workers& workers);

  private:
    template <class Code>
    using Levels = std::vector<std::array<std::unique_ptr<const SparsePieces<Code>>, 3>>;

    std::mutex mutex_;
    Levels<std::uint8_t> bytes_;
    Levels<std::uint16_t> words_;
};

}  // namespace shearwater::shear
