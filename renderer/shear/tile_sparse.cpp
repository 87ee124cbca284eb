// Where a transfer function shows little: a tile's part of the pieces that may be seen.

#include <algorithm>

#include "renderer/shear/fetching.h"
#include "renderer/shear/tile.h"

namespace shearwater::shear {

// Slices that lie in one half layer of micro-bricks, each with some pixels.
template <class Code>
void Tile<Code>::render_sparse(Slices slices, std::span<const std::int64_t> numbers) {
    const std::int64_t half_layer = layer_of<CodeVolume::octant_edge>(numbers.front());
    find_seen(half_layer,
              runs_of(region_of(slices, numbers, nodes_of(codes_.own())), CodeVolume::octant_edge));
    for (const Seen& seen : seen_) {
        const Part part = part_of(slices, numbers, *seen.copied, seen.nodes);
        if (part.count == 0) {
            continue;
        }
        if (!begun_) {
            begin_rays();
        }
        const auto wanted = Slices(part.slices).first(part.count);
        const auto wanted_numbers = std::span(part.numbers).first(part.count);
        // All of a piece's nodes are there: which of them the samples lie between need not be known.
        const VoxelRegion& nodes = seen.nodes;
        Slab<Code> slab = slab_at(wanted, wanted_numbers, nodes, seen.copied->piece.visit,
                                  pieces_->find(*seen.copied, nodes));
        if (composite(wanted, wanted_numbers, slab)) {
            note_met(is_in_one_brick(nodes) ? nodes : region_of(wanted, wanted_numbers, nodes));
        }
    }
}

// What of some slices lies in the cells of a piece that may have opacity.
template <class Code>
typename Tile<Code>::Part Tile<Code>::part_of(Slices slices, std::span<const std::int64_t> numbers,
                                              const typename SparsePieces<Code>::Copied& copied,
                                              const VoxelRegion& nodes) const {
    const auto& [all_fast, all_slow] = pieces_->octants();
    const Piece& piece = copied.piece;
    const auto voxels = [&](std::size_t n, const MicroRun& octants, const MicroRun& all, std::int64_t first,
                            std::int64_t end) {
        const std::int64_t lo = nodes.lo[n];
        return OpenRun{.lo = static_cast<double>(lo + first),
                       .hi = static_cast<double>(lo + end),
                       .open_lo = octants.first == all.first && first == 0,
                       .open_hi = octants.end == all.end && lo + end >= nodes.hi[n]};
    };
    Part part;
    for (std::size_t n = 0; n < slices.size(); ++n) {
        const double plane = 2 * (plan_.node_place(numbers[n]) - static_cast<double>(nodes.lo[2]));
        const PlaneCells& cells = copied.opaque[static_cast<std::size_t>(plane)];
        if (!cells.empty()) {
            add_within(voxels(0, piece.fast, all_fast, cells.fast_first, cells.fast_end),
                       voxels(1, piece.slow, all_slow, cells.slow_first, cells.slow_end), slices[n],
                       numbers[n], part);
        }
    }
    return part;
}

// The pieces that lie in some of a half layer's octants along the fast and the slow axis, front to back;
// their voxels are fetched meanwhile.
template <class Code>
void Tile<Code>::find_seen(std::int64_t half_layer, const std::array<MicroRun, 2>& octants) {
    const auto& [fast, slow] = octants;
    const auto meet = [](const MicroRun& a, const MicroRun& b) { return a.first < b.end && b.first < a.end; };
    const auto distance_along = [&](int axis, const MicroRun& run) {
        return distance(plan_, codes_.micro_bricks(), axis, run);
    };
    constexpr std::int64_t column = SparsePieces<Code>::column;
    seen_.clear();
    for (std::int64_t n = fast.first / column; n * column < fast.end; ++n) {
        for (const auto& copied : pieces_->in(half_layer, n)) {
            const Piece& piece = copied.piece;
            if (piece.slow.first >= slow.end) {
                break;  // and so are those that follow
            }
            if (piece.slow.end <= slow.first || !meet(piece.fast, fast) ||
                (some_hidden_ && !is_seen(piece, half_layer))) {
                continue;
            }
            const VoxelRegion nodes = pieces_->nodes_of(half_layer, piece);
            fetch(copied, nodes);
            // A ray goes away from the eye along both axes.
            seen_.push_back({{distance_along(plan_.fast_axis(), {n * column, (n + 1) * column}),
                              distance_along(plan_.slow_axis(), piece.slow),
                              distance_along(plan_.fast_axis(), piece.fast)},
                             &copied,
                             nodes});
        }
    }
    if (seen_.size() > 1) {
        std::ranges::stable_sort(seen_, {}, &Seen::distance);
    }
}

template <class Code>
void Tile<Code>::fetch(const typename SparsePieces<Code>::Copied& copied, const VoxelRegion& nodes) const {
    const VoxelPlace<Code> place = pieces_->find(copied, nodes);
    const auto bytes = place.plane_stride * nodes.count(2) * static_cast<std::ptrdiff_t>(sizeof(Code));
    Fetching({.first = reinterpret_cast<const char*>(place.first),
              .lines = static_cast<int>(bytes / cache_line) + 1,
              .rows = 1,
              .planes = 1},
             1)
        .step<Into::second>();
}

// Whether anything of it is left of what may be seen: pieces are those of all blocks.
template <class Code>
bool Tile<Code>::is_seen(const Piece& piece, std::int64_t half_layer) const {
    const CodeGrid& grid = codes_.micro_bricks();
    volume::Index3 at;
    at[static_cast<std::size_t>(plan_.face().axis)] = half_layer / 2;
    for (std::int64_t s = piece.slow.first / 2; 2 * s < piece.slow.end; ++s) {
        at[static_cast<std::size_t>(plan_.slow_axis())] = s;
        for (std::int64_t f = piece.fast.first / 2; 2 * f < piece.fast.end; ++f) {
            at[static_cast<std::size_t>(plan_.fast_axis())] = f;
            if (contents_[grid.index(at)].opaque_octants != 0) {
                return true;
            }
        }
    }
    return false;
}

template <class Code>
bool Tile<Code>::is_in_one_brick(const VoxelRegion& region) const {
    const std::int64_t edge = bricks_.edge() >> plan_.level();
    const auto one = [&](std::size_t n) { return region.lo[n] / edge == (region.hi[n] - 1) / edge; };
    return one(0) && one(1);
}

template void Tile<std::uint8_t>::render_sparse(Slices, std::span<const std::int64_t>);
template Tile<std::uint8_t>::Part Tile<std::uint8_t>::part_of(Slices, std::span<const std::int64_t>,
                                                              const SparsePieces<std::uint8_t>::Copied&,
                                                              const VoxelRegion&) const;
template void Tile<std::uint8_t>::find_seen(std::int64_t, const std::array<MicroRun, 2>&);
template void Tile<std::uint8_t>::fetch(const SparsePieces<std::uint8_t>::Copied&, const VoxelRegion&) const;
template bool Tile<std::uint8_t>::is_seen(const Piece&, std::int64_t) const;
template bool Tile<std::uint8_t>::is_in_one_brick(const VoxelRegion&) const;
template void Tile<std::uint16_t>::render_sparse(Slices, std::span<const std::int64_t>);
template Tile<std::uint16_t>::Part Tile<std::uint16_t>::part_of(Slices, std::span<const std::int64_t>,
                                                                const SparsePieces<std::uint16_t>::Copied&,
                                                                const VoxelRegion&) const;
template void Tile<std::uint16_t>::find_seen(std::int64_t, const std::array<MicroRun, 2>&);
template void Tile<std::uint16_t>::fetch(const SparsePieces<std::uint16_t>::Copied&,
                                         const VoxelRegion&) const;
template bool Tile<std::uint16_t>::is_seen(const Piece&, std::int64_t) const;
template bool Tile<std::uint16_t>::is_in_one_brick(const VoxelRegion&) const;

}  // namespace shearwater::shear
