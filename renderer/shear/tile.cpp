#include "renderer/shear/tile.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/shear/fetching.h"

namespace shearwater::shear {

using view::PixelRange;
using view::Rect;

namespace {

// Of a range of pixels those whose samples lie in a run of voxels. Neighbours' ranges meet.
PixelRange pixels_within(const PixelRange& range, double offset, double scale, const OpenRun& voxels) {
    const double pixels = 1 / scale;  // a voxel
    const auto boundary = [&](double voxel) {
        // Up to the next: what is not below 0 is cut off by conversion.
        const double at = std::clamp((voxel - offset) * pixels, static_cast<double>(range.first),
                                     static_cast<double>(range.last));
        const int below = static_cast<int>(at);
        return below + (static_cast<double>(below) < at ? 1 : 0);
    };
    if (scale > 0) {
        return {voxels.open_lo ? range.first : boundary(voxels.lo),
                voxels.open_hi ? range.last : boundary(voxels.hi)};
    }
    return {voxels.open_hi ? range.first : boundary(voxels.hi),
            voxels.open_lo ? range.last : boundary(voxels.lo)};
}

}  // namespace

template <class Code>
Tile<Code>::Tile(const BrickVolume& volume, const Classification& classification,
                 std::span<const Content> contents, const SparsePieces<Code>* pieces, const FacePlan& plan,
                 BricksMet& met)
    : bricks_(volume.bricks()),
      codes_(volume.level(plan.level())),
      classification_(classification),
      contents_(contents),
      pieces_(pieces),
      some_hidden_(contents.data() !=
                   classification.micro_bricks[static_cast<std::size_t>(plan.level())].data()),
      nodes_(classification.segments ? codes_.box() : codes_.own()),
      plan_(plan),
      met_(met),
      voxels_(codes_, plan),
      planes_(std::make_unique_for_overwrite<Planes>()) {}

template <class Code>
bool Tile<Code>::render(const Rect& rect) {
    rect_ = rect;
    begun_ = false;
    live_ = {0, 0, rect.width(), rect.height()};
    if (pieces_ == nullptr && voxels_.turns()) {
        render_by_strips();
    } else {
        render_slices_between(0, plan_.slice_count());
    }
    return begun_;
}

// Of the face's slices [first, end), front to back, or of what the strip has of them: those of one layer of
// micro-bricks, or of the octants that pieces are of, go together, as many as a slab takes.
template <class Code>
void Tile<Code>::render_slices_between(std::int64_t first, std::int64_t end) {
    std::array<Slice<Code>, Slab<Code>::max_slices> slices;
    std::array<std::int64_t, Slab<Code>::max_slices> numbers;
    std::size_t count = 0;
    std::int64_t layer = -1;
    const auto flush = [&] {
        const auto taken = Slices(slices).first(count);
        const auto numbers_taken = std::span<const std::int64_t>(numbers).first(count);
        // Strips of a tile end apart from one another.
        if (count > 0 && (strip_ == nullptr || !begun_ || any_live(taken))) {
            pieces_ != nullptr ? render_sparse(taken, numbers_taken) : render_slices(taken, numbers_taken);
        }
        count = 0;
    };
    for (std::int64_t n = first; n < end; ++n) {
        const std::int64_t k = plan_.slice(n);
        const std::int64_t layer_of_k =
            pieces_ != nullptr ? layer_of<CodeVolume::octant_edge>(k) : layer_of<CodeVolume::micro_edge>(k);
        if (pieces_ != nullptr && !pieces_->any_in(layer_of_k)) {
            continue;
        }
        if (count == slices.size() || layer_of_k != layer) {
            flush();
            if (layer_of_k != layer && begun_ && strip_ == nullptr) {
                narrow_live();
                if (live_.empty()) {
                    return;
                }
            }
        }
        layer = layer_of_k;
        const Slice<Code> slice = slice_of(k);
        if (!slice.pixels.empty()) {
            numbers[count] = k;
            slices[count++] = slice;
        }
    }
    flush();
}

// The cell behind the slice.
template <class Code>
std::int64_t Tile<Code>::cell_of(std::int64_t k) const {
    return std::min(static_cast<std::int64_t>(plan_.node_place(k)),
                    codes_.own().hi[static_cast<std::size_t>(plan_.face().axis)] - 1);
}

// Its layer of so many cells, counted from the sub-volume's first micro-brick on.
template <class Code>
template <std::int64_t edge>
std::int64_t Tile<Code>::layer_of(std::int64_t k) const {
    static_assert(CodeVolume::micro_edge % edge == 0);
    return cell_of(k) / edge -
           codes_.micro_bricks().first(plan_.face().axis) * (CodeVolume::micro_edge / edge);
}

// Which micro-bricks or octants, of that edge, a region is in, along the fast and the slow axis.
template <class Code>
std::array<MicroRun, 2> Tile<Code>::runs_of(const VoxelRegion& region, std::int64_t edge) const {
    const auto run = [&](std::size_t n, int axis) {
        const std::int64_t first = codes_.micro_bricks().first(axis) * CodeVolume::micro_edge;
        return MicroRun{(region.lo[n] - first) / edge, (region.hi[n] - 1 - first) / edge + 1};
    };
    return {run(0, plan_.fast_axis()), run(1, plan_.slow_axis())};
}

// With the pixels of the tile, or of the strip, that the sub-volume owns on it and that have light left,
// counted from the tile's first; its voxels are found later.
template <class Code>
Slice<Code> Tile<Code>::slice_of(std::int64_t k) const {
    const SlicePlan& plan = plan_.slice_plan(k);
    const Rect owned{plan.owned.x0 - rect_.x0, plan.owned.y0 - rect_.y0, plan.owned.x1 - rect_.x0,
                     plan.owned.y1 - rect_.y0};
    Slice<Code> slice{.voxels = nullptr,
                      .next = nullptr,
                      .fast_offset = plan.map.u_offset,
                      .fast_scale = plan.map.u_scale,
                      .slow_offset = plan.map.v_offset,
                      .slow_scale = plan.map.v_scale,
                      .pixels = intersection(live_, owned),
                      .lengths = nullptr};
    if (strip_ != nullptr) {
        const PixelRange rows = rows_within(slice, strip_->voxels);
        slice.pixels.y0 = rows.first;
        slice.pixels.y1 = rows.last;
    }
    return slice;
}

// The pixels of a slice whose samples lie in a run of voxels along the slow axis.
template <class Code>
PixelRange Tile<Code>::rows_within(const Slice<Code>& slice, const OpenRun& voxels) const {
    return pixels_within({slice.pixels.y0, slice.pixels.y1}, slice.slow_offset + slice.slow_scale * rect_.y0,
                         slice.slow_scale, voxels);
}

// Slices that lie in one layer of micro-bricks, each with some pixels.
template <class Code>
void Tile<Code>::render_slices(Slices slices, std::span<const std::int64_t> numbers) {
    const std::int64_t number = layer_of<CodeVolume::micro_edge>(numbers.front());
    const VoxelRegion region = region_of(slices, numbers, nodes_of(codes_.own()));
    const auto [fast_bricks, slow_bricks] = runs_of(region, CodeVolume::micro_edge);
    const MicroLayer layer(codes_, contents_, plan_, number, fast_bricks, slow_bricks);
    if (layer.visit() == Visit::none) {
        return;
    }
    if (layer.visit() != Visit::parts) {
        render_part(slices, numbers, layer.visit(), true);
        return;
    }
    const auto [fast, slow] = runs_of(region, CodeVolume::octant_edge);
    if (layer.halves_alike()) {
        render_octants(slices, numbers, layer, 0, fast, slow);
        return;
    }
    // Half a layer at a time, front to back.
    const std::int64_t middle =
        (codes_.micro_bricks().first(plan_.face().axis) + number) * CodeVolume::micro_edge +
        CodeVolume::octant_edge;
    for (std::size_t first = 0, end = 0; first < slices.size(); first = end) {
        const bool farther = cell_of(numbers[first]) >= middle;
        while (end < slices.size() && (cell_of(numbers[end]) >= middle) == farther) {
            ++end;
        }
        render_octants(slices.subspan(first, end - first), numbers.subspan(first, end - first), layer,
                       farther ? 1 : 0, fast, slow);
    }
}

// Row by row, those together that are alike. The memory that all of it takes is fetched first: it lies too
// strewn for the processor to foresee.
template <class Code>
void Tile<Code>::render_octants(Slices slices, std::span<const std::int64_t> numbers, const MicroLayer& layer,
                                int half, const MicroRun& fast, const MicroRun& slow) {
    front_to_back(plan_, codes_.micro_bricks(), plan_.slow_axis(), slow, octant_rows_);
    octant_pieces_.clear();
    runs_.clear();
    std::size_t first = 0;  // of the pieces of the last rows
    for (const std::int64_t row : octant_rows_) {
        layer.runs(fast, row, half, next_runs_);
        if (!next_runs_.empty() && alike(next_runs_, runs_) &&
            (row == octant_pieces_.back().slow.end || row == octant_pieces_.back().slow.first - 1)) {
            for (std::size_t n = 0; n < next_runs_.size(); ++n) {
                Piece& piece = octant_pieces_[first + n];
                piece.slow = {std::min(piece.slow.first, row), std::max(piece.slow.end, row + 1)};
                piece.visit = together(piece.visit, next_runs_[n].visit);
            }
            continue;
        }
        first = octant_pieces_.size();
        for (const OctantRun& run : next_runs_) {
            octant_pieces_.push_back({run.along, {row, row + 1}, run.visit});
        }
        std::swap(runs_, next_runs_);
    }
    for (const Piece& piece : octant_pieces_) {
        Fetching(voxels_.ahead(region_of(piece.fast, piece.slow, numbers)), 1).step<Into::second>();
    }
    for (const Piece& piece : octant_pieces_) {
        const Part part = part_of(slices, numbers, piece, fast, slow);
        if (part.count > 0) {
            render_part(Slices(part.slices).first(part.count), std::span(part.numbers).first(part.count),
                        piece.visit, false);
        }
    }
}

// What of some slices lies in a piece; `fast` and `slow` are all octants beyond which there are no samples.
template <class Code>
typename Tile<Code>::Part Tile<Code>::part_of(Slices slices, std::span<const std::int64_t> numbers,
                                              const Piece& piece, const MicroRun& fast,
                                              const MicroRun& slow) const {
    const auto voxels = [&](int axis, const MicroRun& octants, const MicroRun& all) {
        const std::int64_t first = codes_.micro_bricks().first(axis) * CodeVolume::micro_edge;
        return OpenRun{.lo = static_cast<double>(first + octants.first * CodeVolume::octant_edge),
                       .hi = static_cast<double>(first + octants.end * CodeVolume::octant_edge),
                       .open_lo = octants.first == all.first,
                       .open_hi = octants.end == all.end};
    };
    const OpenRun fast_voxels = voxels(plan_.fast_axis(), piece.fast, fast);
    const OpenRun slow_voxels = voxels(plan_.slow_axis(), piece.slow, slow);
    Part part;
    for (std::size_t n = 0; n < slices.size(); ++n) {
        add_within(fast_voxels, slow_voxels, slices[n], numbers[n], part);
    }
    return part;
}

// What of a slice lies in some voxels.
template <class Code>
void Tile<Code>::add_within(const OpenRun& fast, const OpenRun& slow, const Slice<Code>& slice,
                            std::int64_t number, Part& part) const {
    const PixelRange columns =
        pixels_within({slice.pixels.x0, slice.pixels.x1}, slice.fast_offset + slice.fast_scale * rect_.x0,
                      slice.fast_scale, fast);
    const PixelRange rows = rows_within(slice, slow);
    if (!columns.empty() && !rows.empty()) {
        part.slices[part.count] = slice;
        part.slices[part.count].pixels = {columns.first, rows.first, columns.last, rows.last};
        part.numbers[part.count++] = number;
    }
}

// Parts of slices to be visited alike. Where it is the whole of them, so will the next slices be.
template <class Code>
void Tile<Code>::render_part(Slices slices, std::span<const std::int64_t> numbers, Visit visit, bool whole) {
    if (!begun_) {
        begin_rays();
    }
    if (classification_.segments) {
        render_segments(slices, numbers, visit, whole);
        return;
    }
    const VoxelRegion region = region_of(slices, numbers, nodes_of(nodes_));
    Slab<Code> slab = slab_of(slices, numbers, region, visit, whole);
    if (composite(slices, numbers, slab)) {
        note_met(region);
    }
}

// False if no ray took a sample.
template <class Code>
bool Tile<Code>::composite(Slices slices, std::span<const std::int64_t> numbers, Slab<Code>& slab) {
    for (std::size_t n = 0; n < slices.size(); ++n) {
        Slice<Code>& slice = slab.slices[n];
        slice.lengths = lengths_on(numbers[n], slice.pixels, n);
    }
    const std::uint64_t taken = composite_slab(slab, classification_.table, rays());
    samples_ += taken;
    return taken > 0;
}

// The slices with the region of voxels that their samples lie between.
template <class Code>
Slab<Code> Tile<Code>::slab_of(Slices slices, std::span<const std::int64_t> numbers,
                               const VoxelRegion& region, Visit visit, bool whole) {
    if (!voxels_.has(region)) {
        voxels_.turn(region, whole ? turned_with(region) : std::span<const VoxelRegion>());
    }
    Slab<Code> slab = slab_at(slices, numbers, region, visit, voxels_.find(region));
    if (whole && !voxels_.turns()) {
        slab.ahead = voxels_.ahead(behind(region));
    }
    return slab;
}

template <class Code>
Slab<Code> Tile<Code>::slab_at(Slices slices, std::span<const std::int64_t> numbers,
                               const VoxelRegion& region, Visit visit, const VoxelPlace<Code>& place) const {
    Slab<Code> slab;  // whose other slices are never looked at
    slab.fast_first = region.lo[0];
    slab.slow_first = region.lo[1];
    slab.fast_cells = region.hi[0] - region.lo[0];
    slab.slow_cells = region.hi[1] - region.lo[1];
    slab.stride = place.row_stride;
    slab.ahead = {};
    slab.fast_pixel = rect_.x0;
    slab.slow_pixel = rect_.y0;
    slab.blanks = visit == Visit::with_blanks;
    slab.between_nodes = between_nodes_;
    slab.faint = faint_;
    slab.count = static_cast<int>(slices.size());
    for (std::size_t n = 0; n < slices.size(); ++n) {
        const double w = plan_.node_place(numbers[n]);
        const auto plane = static_cast<std::int64_t>(w);
        Slice<Code>& slice = slab.slices[n];
        slice = slices[n];
        slice.voxels = place.first + (plane - region.lo[2]) * place.plane_stride;
        slice.next = static_cast<double>(plane) < w ? slice.voxels + place.plane_stride : nullptr;
    }
    return slab;
}

template <class Code>
void Tile<Code>::note_met(const VoxelRegion& region) {
    const std::array<int, 3> axes{plan_.fast_axis(), plan_.slow_axis(), plan_.face().axis};
    volume::Index3 first, last;
    for (std::size_t n = 0; n < 3; ++n) {
        const auto a = static_cast<std::size_t>(axes[n]);
        // A coarse level's nodes may lie outside the box.
        const auto brick_of = [&](std::int64_t voxel) {
            return std::clamp<std::int64_t>(voxel / bricks_.edge() - bricks_.first(axes[n]), 0,
                                            bricks_.counts()[a] - 1);
        };
        first[a] = brick_of(region.lo[n] << plan_.level());
        // A region may be one plane: that of the slice, or the sub-volume's last.
        last[a] = std::max(brick_of((region.hi[n] << plan_.level()) - 1), first[a]);
    }
    volume::Index3 at;
    for (at[2] = first[2]; at[2] <= last[2]; ++at[2]) {
        for (at[1] = first[1]; at[1] <= last[1]; ++at[1]) {
            for (at[0] = first[0]; at[0] <= last[0]; ++at[0]) {
                const std::size_t brick = bricks_.index(at);
                // Written once: what all threads write to, they would pass to and fro.
                if (classification_.opaque[brick] != 0 && met_[brick].load(std::memory_order_relaxed) == 0) {
                    met_[brick].store(1, std::memory_order_relaxed);
                }
            }
        }
    }
}

template std::int64_t Tile<std::uint8_t>::layer_of<CodeVolume::octant_edge>(std::int64_t) const;
template std::int64_t Tile<std::uint16_t>::layer_of<CodeVolume::octant_edge>(std::int64_t) const;
template class Tile<std::uint8_t>;
template class Tile<std::uint16_t>;

}  // namespace shearwater::shear
