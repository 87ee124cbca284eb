#include "renderer/shear/sparse_pieces.h"

#include <algorithm>
#include <utility>

#include "renderer/shear/fetching.h"
#include "renderer/shear/kernel.h"
#include "renderer/shear/tile_voxels.h"

namespace shearwater::shear {

namespace {

constexpr std::int64_t edge = CodeVolume::octant_edge;

// Fast, slow and principal, as FacePlan has them: rows run along the in-plane axis whose voxels are adjacent,
// or will be.
std::array<int, 3> axes_of(int principal) {
    return {principal == 0 ? 1 : 0, principal == 2 ? 1 : 2, principal};
}

}  // namespace

// Rows of a column, one after the other: those that are alike make pieces together.
template <class Code>
class SparsePieces<Code>::Adding {
  public:
    explicit Adding(Found& found) : found_(found), begin_(found.pieces.size()), last_(begin_) {}

    std::size_t begin() const { return begin_; }
    void add(std::int64_t row, std::vector<OctantRun>& runs) {
        if (!runs.empty() && alike(runs, last_runs_) &&
            row - found_.pieces[last_].piece.slow.first < most_rows) {
            for (std::size_t n = 0; n < runs.size(); ++n) {
                Piece& piece = found_.pieces[last_ + n].piece;
                ++piece.slow.end;
                piece.visit = together(piece.visit, runs[n].visit);
            }
            return;
        }
        last_ = found_.pieces.size();
        for (const OctantRun& run : runs) {
            found_.pieces.push_back({{run.along, {row, row + 1}, run.visit}});
        }
        std::swap(runs, last_runs_);
    }

  private:
    Found& found_;
    const std::size_t begin_;
    std::size_t last_;  // of the last row's pieces the first
    std::vector<OctantRun> last_runs_;
};

template <class Code>
SparsePieces<Code>::SparsePieces(const CodeVolume& codes, const OpacityTable& table,
                                 std::span<const Content> contents, int axis, base::Workers& workers)
    : codes_(codes), opaque_codes_(table.opaque_codes()), axes_(axes_of(axis)) {
    const volume::Index3& counts = codes.micro_bricks().counts();
    for (std::size_t n = 0; n < octants_.size(); ++n) {
        octants_[n] = {0, 2 * counts[static_cast<std::size_t>(axes_[n])]};
    }
    columns_ = static_cast<std::size_t>((octants_[0].end + column - 1) / column);
    const std::int64_t layers = counts[static_cast<std::size_t>(axis)];
    std::vector<FoundInHalves> found(static_cast<std::size_t>(layers));
    workers.for_each(layers, [&](std::int64_t layer) {
        found[static_cast<std::size_t>(layer)] = found_in(layer, contents);
    });
    begins_ = {0};
    std::size_t size = 0;
    for (std::int64_t half_layer = 0; half_layer < 2 * layers; ++half_layer) {
        const Found& here =
            found[static_cast<std::size_t>(half_layer / 2)][static_cast<std::size_t>(half_layer % 2)];
        for (const std::size_t count : here.of_columns) {
            begins_.push_back(begins_.back() + count);
        }
        for (const Copied& copied : here.pieces) {
            const VoxelRegion nodes = nodes_of(half_layer, copied.piece);
            pieces_.push_back({copied.piece, size});
            size += static_cast<std::size_t>(nodes.count(0) * nodes.count(1) * nodes.count(2));
        }
    }
    voxels_.resize(size + voxel_padding / sizeof(Code));
    workers.for_each(2 * layers, [this](std::int64_t half_layer) { copy_voxels(half_layer); });
}

// Those of a layer of micro-bricks, nearer and farther.
template <class Code>
auto SparsePieces<Code>::found_in(std::int64_t layer, std::span<const Content> contents) const
    -> FoundInHalves {
    const volume::Index3& counts = codes_.micro_bricks().counts();
    const volume::Index3 strides{1, counts[0], counts[0] * counts[1]};
    const auto stride = [&](std::size_t n) { return strides[static_cast<std::size_t>(axes_[n])]; };
    const Content* const first_row = contents.data() + layer * stride(2);
    FoundInHalves found;
    std::vector<OctantRun> runs;
    for (std::int64_t first = 0; first < octants_[0].end; first += column) {
        const MicroRun across{first, std::min(first + column, octants_[0].end)};
        const MicroRun micro_bricks{across.first / 2, (across.end + 1) / 2};
        std::array<Adding, 2> halves{Adding(found[0]), Adding(found[1])};
        for (std::int64_t row = 0; 2 * row < octants_[1].end; ++row) {
            const auto content_at = [of_row = first_row + row * stride(1), along = stride(0)](
                                        std::int64_t n) -> const Content& { return of_row[n * along]; };
            unsigned any = 0;  // most rows have none at all
            for (std::int64_t n = micro_bricks.first; n < micro_bricks.end; ++n) {
                any |= content_at(n).opaque_octants;
            }
            for (int octant_row = 0; octant_row < 2; ++octant_row) {
                for (int half = 0; half < 2; ++half) {
                    const int near = octant_row << axes_[1] | half << axes_[2];
                    const int far = near | 1 << axes_[0];
                    runs.clear();
                    if ((any & (1U << near | 1U << far)) != 0) {
                        find_runs(content_at, micro_bricks, across, near, far, runs);
                    }
                    halves[static_cast<std::size_t>(half)].add(2 * row + octant_row, runs);
                }
            }
        }
        for (std::size_t half = 0; half < halves.size(); ++half) {
            found[half].of_columns.push_back(found[half].pieces.size() - halves[half].begin());
        }
    }
    return found;
}

template <class Code>
VoxelRegion SparsePieces<Code>::nodes_of(std::int64_t half_layer, const Piece& piece) const {
    VoxelRegion nodes;
    const std::array<MicroRun, 3> octants{piece.fast, piece.slow, MicroRun{half_layer, half_layer + 1}};
    for (std::size_t n = 0; n < octants.size(); ++n) {
        const auto a = static_cast<std::size_t>(axes_[n]);
        const std::int64_t first = codes_.micro_bricks().first(axes_[n]) * CodeVolume::micro_edge;
        nodes.lo[n] = std::max(first + octants[n].first * edge, codes_.own().lo[a]);
        nodes.hi[n] = std::min(first + octants[n].end * edge, codes_.own().hi[a]);
    }
    return nodes;
}

template <class Code>
void SparsePieces<Code>::copy_voxels(std::int64_t half_layer) {
    const CodeArray& codes = codes_.best_for(axes_[2]);
    const std::size_t first = begins_[slot(half_layer)], end = begins_[slot(half_layer + 1)];
    const auto pieces = std::span(pieces_).subspan(first, end - first);
    // They lie too strewn for the processor to foresee what comes next.
    constexpr std::size_t ahead = 3;
    const auto fetch = [&](std::size_t n) {
        if (n < pieces.size()) {
            Fetching(ahead_of<Code>(codes, axes_, nodes_of(half_layer, pieces[n].piece)), 1)
                .template step<Into::second>();
        }
    };
    for (std::size_t n = 0; n < ahead; ++n) {
        fetch(n);
    }
    for (std::size_t n = 0; n < pieces.size(); ++n) {
        fetch(n + ahead);
        Copied& copied = pieces[n];
        const VoxelRegion nodes = nodes_of(half_layer, copied.piece);
        volume::Index3 at;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            at[static_cast<std::size_t>(axes_[axis])] = nodes.lo[axis];
        }
        const Code* const lowest = &codes.codes<Code>()[codes.offset(at)];
        Code* to = &voxels_[copied.first];
        for (std::int64_t w = 0; w < nodes.count(2); ++w) {
            for (std::int64_t v = 0; v < nodes.count(1); ++v) {
                const Code* from = lowest + w * codes.stride(axes_[2]) + v * codes.stride(axes_[1]);
                if (codes.stride(axes_[0]) == 1) {
                    to = std::copy_n(from, nodes.count(0), to);
                    continue;
                }
                for (std::int64_t u = 0; u < nodes.count(0); ++u, from += codes.stride(axes_[0])) {
                    *to++ = *from;
                }
            }
        }
        find_opaque_cells<Code>({&voxels_[copied.first], nodes.count(0), nodes.count(1), nodes.count(2)},
                                opaque_codes_, copied.opaque);
    }
}

template class SparsePieces<std::uint8_t>;
template class SparsePieces<std::uint16_t>;

bool SparseFaces::pay(std::uint64_t opaque, std::uint64_t octants) {
    constexpr std::uint64_t most = 1U << 18U, of_each = 32;
    return opaque <= most && opaque * of_each <= octants;
}

template <class Code>
const SparsePieces<Code>& SparseFaces::pieces(const CodeVolume& codes, int level, const OpacityTable& table,
                                              std::span<const Content> contents, int axis,
                                              base::Workers& workers) {
    const std::lock_guard lock(mutex_);
    Levels<Code>& levels = [this]() -> auto& {
        if constexpr (sizeof(Code) == 1) {
            return bytes_;
        } else {
            return words_;
        }
    }
    ();
    if (std::cmp_greater_equal(level, levels.size())) {
        levels.resize(static_cast<std::size_t>(level) + 1);
    }
    auto& pieces = levels[static_cast<std::size_t>(level)][static_cast<std::size_t>(axis)];
    if (!pieces) {
        pieces = std::make_unique<const SparsePieces<Code>>(codes, table, contents, axis, workers);
    }
    return *pieces;
}

template const SparsePieces<std::uint8_t>& SparseFaces::pieces(const CodeVolume&, int, const OpacityTable&,
                                                               std::span<const Content>, int, base::Workers&);
template const SparsePieces<std::uint16_t>& SparseFaces::pieces(const CodeVolume&, int, const OpacityTable&,
                                                                std::span<const Content>, int,
                                                                base::Workers&);

}  // namespace shearwater::shear
