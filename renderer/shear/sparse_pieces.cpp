#include "renderer/shear/sparse_pieces.h"

#include <algorithm>
#include <utility>

#include "renderer/shear/kernel.h"

namespace shearwater::shear {

namespace {

constexpr std::int64_t edge = CodeVolume::octant_edge;

// Fast, slow and principal, as FacePlan has them: rows run along the in-plane axis whose voxels are adjacent,
// or will be.
std::array<int, 3> axes_of(int principal) {
    return {principal == 0 ? 1 : 0, principal == 2 ? 1 : 2, principal};
}

}  // namespace

template <class Code>
SparsePieces<Code>::SparsePieces(const CodeVolume& codes, std::span<const Content> contents, int axis,
                                 base::Workers& workers)
    : codes_(codes), axes_(axes_of(axis)) {
    const volume::Index3& counts = codes.micro_bricks().counts();
    for (std::size_t n = 0; n < octants_.size(); ++n) {
        octants_[n] = {0, 2 * counts[static_cast<std::size_t>(axes_[n])]};
    }
    columns_ = static_cast<std::size_t>((octants_[0].end + column - 1) / column);
    const std::int64_t half_layers = 2 * counts[static_cast<std::size_t>(axis)];
    std::vector<Found> found(static_cast<std::size_t>(half_layers));
    workers.for_each(half_layers, [&](std::int64_t half_layer) {
        found[static_cast<std::size_t>(half_layer)] = found_in(half_layer, contents);
    });
    begins_ = {0};
    std::size_t size = 0;
    for (std::int64_t half_layer = 0; half_layer < half_layers; ++half_layer) {
        const Found& here = found[static_cast<std::size_t>(half_layer)];
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
    workers.for_each(half_layers, [this](std::int64_t half_layer) { copy_voxels(half_layer); });
}

template <class Code>
auto SparsePieces<Code>::found_in(std::int64_t half_layer, std::span<const Content> contents) const -> Found {
    const volume::Index3& counts = codes_.micro_bricks().counts();
    const volume::Index3 strides{1, counts[0], counts[0] * counts[1]};
    const auto stride = [&](std::size_t n) { return strides[static_cast<std::size_t>(axes_[n])]; };
    const Content* const layer = contents.data() + half_layer / 2 * stride(2);
    Found found;
    std::vector<OctantRun> runs, last_runs;
    for (std::int64_t first = 0; first < octants_[0].end; first += column) {
        const MicroRun across{first, std::min(first + column, octants_[0].end)};
        const MicroRun micro_bricks{across.first / 2, (across.end + 1) / 2};
        const std::size_t begin = found.pieces.size();
        std::size_t last = begin;  // of the last row's pieces the first
        last_runs.clear();
        for (std::int64_t row = 0; row < octants_[1].end; ++row) {
            const Content* const contents_of_row = layer + row / 2 * stride(1);
            const auto content_at = [&](std::int64_t n) -> const Content& {
                return contents_of_row[n * stride(0)];
            };
            const auto near = static_cast<int>(row % 2 << axes_[1] | half_layer % 2 << axes_[2]);
            find_runs(content_at, micro_bricks, across, near, near | 1 << axes_[0], runs);
            if (!runs.empty() && runs == last_runs) {
                for (Copied& copied : std::span(found.pieces).subspan(last)) {
                    ++copied.piece.slow.end;
                }
                continue;
            }
            last = found.pieces.size();
            for (const OctantRun& run : runs) {
                found.pieces.push_back({{run.along, {row, row + 1}, run.visit}});
            }
            std::swap(runs, last_runs);
        }
        found.of_columns.push_back(found.pieces.size() - begin);
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
    for (const Copied& copied : std::span(pieces_).subspan(first, end - first)) {
        const VoxelRegion nodes = nodes_of(half_layer, copied.piece);
        volume::Index3 at;
        for (std::size_t n = 0; n < 3; ++n) {
            at[static_cast<std::size_t>(axes_[n])] = nodes.lo[n];
        }
        const Code* const lowest = &codes.codes<Code>()[codes.offset(at)];
        Code* to = &voxels_[copied.first];
        for (std::int64_t w = 0; w < nodes.count(2); ++w) {
            for (std::int64_t v = 0; v < nodes.count(1); ++v) {
                const Code* from = lowest + w * codes.stride(axes_[2]) + v * codes.stride(axes_[1]);
                for (std::int64_t u = 0; u < nodes.count(0); ++u, from += codes.stride(axes_[0])) {
                    *to++ = *from;
                }
            }
        }
    }
}

template class SparsePieces<std::uint8_t>;
template class SparsePieces<std::uint16_t>;

bool SparseFaces::pay(std::uint64_t opaque, std::uint64_t octants) {
    constexpr std::uint64_t most = 1U << 18U, of_each = 32;
    return opaque <= most && opaque * of_each <= octants;
}

template <class Code>
const SparsePieces<Code>* SparseFaces::pieces(const CodeVolume& codes, int level,
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
    Face<Code>& face = levels[static_cast<std::size_t>(level)][static_cast<std::size_t>(axis)];
    if (!face.pieces && std::exchange(face.asked_for, true)) {
        face.pieces = std::make_unique<const SparsePieces<Code>>(codes, contents, axis, workers);
    }
    return face.pieces.get();
}

template const SparsePieces<std::uint8_t>* SparseFaces::pieces(const CodeVolume&, int,
                                                               std::span<const Content>, int, base::Workers&);
template const SparsePieces<std::uint16_t>* SparseFaces::pieces(const CodeVolume&, int,
                                                                std::span<const Content>, int,
                                                                base::Workers&);

}  // namespace shearwater::shear
