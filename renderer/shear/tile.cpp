#include "renderer/shear/tile.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <utility>

namespace shearwater::shear {

using view::PixelRange;
using view::Rect;
using view::SliceRange;
using volume::Index3;

namespace {

// The pixels whose samples lie in the micro-bricks [first, end) of a brick along one axis, those at its
// ends taking what the brick owns there. Neighbours' ranges meet.
PixelRange pixels_of_micro_bricks(const PixelRange& whole, double offset, double scale, int first, int end,
                                  int count) {
    const auto boundary = [&](int micro) {
        const double at = (static_cast<double>(micro * MicroBricks::edge) - offset) / scale;
        return static_cast<int>(
            std::clamp(std::ceil(at), static_cast<double>(whole.first), static_cast<double>(whole.last)));
    };
    if (scale > 0) {
        return {first == 0 ? whole.first : boundary(first), end == count ? whole.last : boundary(end)};
    }
    return {end == count ? whole.first : boundary(end), first == 0 ? whole.last : boundary(first)};
}

// The next run of set bits of a row of micro-bricks from `from` on; first == end where there is none.
struct Run {
    int first, end;
};
Run next_run(unsigned bits, int from) {
    bits &= ~0U << from;
    if (bits == 0) {
        return {0, 0};
    }
    const int first = std::countr_zero(bits);
    return {first, first + std::countr_one(bits >> first)};
}

// Extinctions of nodes that differ by less than these halvings of light a step are not told apart: as much as
// one opacity in a hundred, at most half of which a sample is wrong by, this way or that.
constexpr float jump_seen = 1.0F / 64;

int micro_bricks_along(std::int64_t cells) {
    return static_cast<int>((cells + MicroBricks::edge - 1) / MicroBricks::edge);
}

}  // namespace

template <class Code>
Tile<Code>::Tile(const BrickVolume& volume, std::span<const Code> codes, const Classification& classification,
                 const FacePlan& plan, BricksMet& met)
    : volume_(volume),
      codes_(codes),
      classification_(classification),
      plan_(plan),
      met_(met),
      planes_(std::make_unique<Planes>()) {}

template <class Code>
void Tile<Code>::render(const Rect& rect) {
    rect_ = rect;
    for (Plane* const plane : {&planes_->r, &planes_->g, &planes_->b, &planes_->a}) {
        plane->fill(0);
    }
    const float unit = classification_.table.depth_unit();
    float longest = 0;
    for (int j = rect.y0; j < rect.y1; ++j) {
        const std::span<float> row(&planes_->steps[slot(rect.x0, j)], static_cast<std::size_t>(rect.width()));
        plan_.steps(rect.x0, j, row);
        for (float& step : row) {
            // Finite, so that times no extinction it is nothing.
            step = std::min(step * unit, 1e38F);
            longest = std::max(longest, step);
        }
    }
    between_nodes_ = classification_.table.steepest() * longest > jump_seen;
    for (const std::int64_t layer : plan_.layers()) {
        render_layer(layer);
        if (opaque()) {
            return;
        }
    }
}

template <class Code>
bool Tile<Code>::opaque() const {
    for (int j = rect_.y0; j < rect_.y1; ++j) {
        const float* const a = &planes_->a[slot(rect_.x0, j)];
        if (std::any_of(a, a + rect_.width(), [](float alpha) { return alpha < opaque_enough; })) {
            return false;
        }
    }
    return true;
}

// The columns (or rows) of bricks with samples in [lo, hi) on some of the slices. A voxel plane's place
// in the image changes one way only from slice to slice, so the end slices bound the others.
template <class Code>
std::vector<std::int64_t> Tile<Code>::met_by(const std::vector<std::int64_t>& places,
                                             const SliceRange& slices, int lo, int hi,
                                             const PixelRange& (FacePlan::*pixels)(std::int64_t, std::int64_t)
                                                 const) const {
    std::vector<std::int64_t> found;
    for (const std::int64_t place : places) {
        const PixelRange& near = (plan_.*pixels)(slices.first, place);
        const PixelRange& far = (plan_.*pixels)(slices.last, place);
        if (std::min(near.first, far.first) < hi && std::max(near.last, far.last) > lo) {
            found.push_back(place);
        }
    }
    return found;
}

template <class Code>
void Tile<Code>::render_layer(std::int64_t layer) {
    const SliceRange slices = plan_.slices_of_layer(layer);
    if (slices.empty()) {
        return;
    }
    const auto columns = met_by(plan_.columns(), slices, rect_.x0, rect_.x1, &FacePlan::pixels_of_column);
    const auto rows = met_by(plan_.rows(), slices, rect_.y0, rect_.y1, &FacePlan::pixels_of_row);
    Index3 place{};
    place[static_cast<std::size_t>(plan_.face().axis)] = layer;
    for (const std::int64_t row : rows) {
        place[static_cast<std::size_t>(plan_.slow_axis())] = row;
        for (const std::int64_t column : columns) {
            place[static_cast<std::size_t>(plan_.fast_axis())] = column;
            render_brick(volume_.brick(place[0], place[1], place[2]), slices, column, row);
        }
    }
}

// The voxels of the brick that the tile's pixels may need: those of its opaque micro-bricks which the
// samples of the two end slices span.
template <class Code>
VoxelRanges Tile<Code>::needed_of(const Brick& brick, std::uint64_t opaque, const SliceRange& slices) const {
    const std::array<int, 3> axes{plan_.fast_axis(), plan_.slow_axis(), plan_.face().axis};
    VoxelRanges needed = MicroMask(opaque, plan_).extent();
    const auto near = plan_.slice_map(plan_.factorisation().slice_place(slices.first));
    const auto far = plan_.slice_map(plan_.factorisation().slice_place(slices.last));
    const auto span = [](double offset, double scale, int first, int end) {
        const double a = offset + scale * first;
        const double b = offset + scale * (end - 1);
        return std::pair(std::min(a, b), std::max(a, b));
    };
    for (std::size_t n = 0; n < 3; ++n) {
        const auto lo = brick.box.lo[static_cast<std::size_t>(axes[n])];
        const std::int64_t cells = brick.box.cells(axes[n]);
        auto& [first, last] = needed[n];
        first *= MicroBricks::edge;
        last = std::min((last + 1) * MicroBricks::edge, cells);
        if (n == 2) {
            continue;
        }
        double least = static_cast<double>(cells), most = 0;
        for (const view::SliceMap& map : {near, far}) {
            const auto [a, b] = n == 0 ? span(map.u_offset, map.u_scale, rect_.x0, rect_.x1)
                                       : span(map.v_offset, map.v_scale, rect_.y0, rect_.y1);
            least = std::min(least, a - static_cast<double>(lo));
            most = std::max(most, b - static_cast<double>(lo));
        }
        first = std::max(first, static_cast<std::int64_t>(std::max(std::floor(least), 0.0)));
        last = std::min(last, static_cast<std::int64_t>(std::max(std::floor(most), 0.0)) + 1);
        first = std::min(first, last);
    }
    return needed;
}

template <class Code>
void Tile<Code>::render_brick(const Brick& brick, const SliceRange& slices, std::int64_t column,
                              std::int64_t row) {
    const auto number = static_cast<std::size_t>(&brick - volume_.bricks().data());
    const std::uint64_t opaque = classification_.opaque[number];
    if (opaque == 0) {
        return;
    }
    const auto oriented = orient(brick, codes_, opaque, plan_, needed_of(brick, opaque, slices), scratch_);
    // The slices of one layer of micro-bricks go together, as many as a slab takes.
    std::array<SlicePixels, Slab<Code>::max_slices> together;
    std::size_t count = 0;
    std::int64_t layer = 0;
    bool met = false;
    const auto flush = [&] {
        if (count > 0) {
            render_slices(oriented, std::span(together).first(count));
            met = true;
        }
        count = 0;
    };
    for (std::int64_t n = 0; n <= slices.last - slices.first; ++n) {
        const std::int64_t k = plan_.face().sign > 0 ? slices.first + n : slices.last - n;
        const std::int64_t layer_of_k = oriented.micro_layer(plan_.factorisation().slice_place(k));
        if (count == together.size() || layer_of_k != layer) {
            flush();
        }
        layer = layer_of_k;
        const PixelRange& fast = plan_.pixels_of_column(k, column);
        const PixelRange& slow = plan_.pixels_of_row(k, row);
        const Rect pixels = intersection(rect_, {fast.first, slow.first, fast.last, slow.last});
        if (!pixels.empty()) {
            together[count++] = {
                k, {pixels.x0 - rect_.x0, pixels.y0 - rect_.y0, pixels.x1 - rect_.x0, pixels.y1 - rect_.y0}};
        }
    }
    flush();
    if (met) {
        met_[number].store(1, std::memory_order_relaxed);
    }
}

// Pixels are counted from the tile's first.
template <class Code>
Slice<Code> Tile<Code>::slice_of(const OrientedBrick<Code>& brick, const SlicePixels& slice) const {
    const double w = plan_.factorisation().slice_place(slice.k);
    const double deep = w - static_cast<double>(brick.lo[2]);
    const auto plane = static_cast<std::int64_t>(deep);
    const Code* const voxels = brick.voxels + plane * brick.plane_stride;
    const view::SliceMap map = plan_.slice_map(w);
    return {.voxels = voxels,
            .next = static_cast<double>(plane) < deep ? voxels + brick.plane_stride : nullptr,
            .fast_offset = map.u_offset,
            .fast_scale = map.u_scale,
            .slow_offset = map.v_offset,
            .slow_scale = map.v_scale,
            .pixels = slice.pixels,
            .lengths = planes_->steps.data()};
}

// Slices that lie in one layer of micro-bricks.
template <class Code>
void Tile<Code>::render_slices(const OrientedBrick<Code>& brick, std::span<const SlicePixels> slices) {
    const double w = plan_.factorisation().slice_place(slices.front().k);
    const MicroPlane opaque = brick.opaque.layer(brick.micro_layer(w));
    if (opaque == 0) {
        return;
    }
    Slab<Code> slab{.stride = brick.row_stride,
                    .fast_first = brick.lo[0],
                    .slow_first = brick.lo[1],
                    .fast_pixel = rect_.x0,
                    .slow_pixel = rect_.y0,
                    .fast_cells = static_cast<int>(brick.cells[0]),
                    .slow_cells = static_cast<int>(brick.cells[1]),
                    .blanks = brick.blanks,
                    .between_nodes = between_nodes_,
                    .count = 0,
                    .slices = {}};
    std::array<Slice<Code>, Slab<Code>::max_slices> whole;
    for (std::size_t n = 0; n < slices.size(); ++n) {
        whole[n] = slice_of(brick, slices[n]);
        whole[n].lengths = lengths_on(slices[n].k, slices[n].pixels, planes_->lengths[n]);
    }
    const int fast_count = micro_bricks_along(brick.cells[0]);
    const int slow_count = micro_bricks_along(brick.cells[1]);
    const auto bits_of = [opaque](int slow) { return static_cast<unsigned>(opaque >> (4 * slow)) & 15; };
    for (int first = 0; first < slow_count;) {
        const unsigned bits = bits_of(first);
        int end = first + 1;
        while (end < slow_count && bits_of(end) == bits) {
            ++end;
        }
        for (Run run = next_run(bits, 0); run.first < run.end; run = next_run(bits, run.end)) {
            slab.count = 0;
            for (std::size_t n = 0; n < slices.size(); ++n) {
                Slice<Code>& slice = slab.slices[static_cast<std::size_t>(slab.count)];
                slice = whole[n];
                const auto offset = [&](double of_cube, double scale, int pixel, std::int64_t voxel) {
                    return of_cube + scale * pixel - static_cast<double>(voxel);
                };
                const PixelRange columns =
                    pixels_of_micro_bricks({slice.pixels.x0, slice.pixels.x1},
                                           offset(slice.fast_offset, slice.fast_scale, rect_.x0, brick.lo[0]),
                                           slice.fast_scale, run.first, run.end, fast_count);
                const PixelRange rows =
                    pixels_of_micro_bricks({slice.pixels.y0, slice.pixels.y1},
                                           offset(slice.slow_offset, slice.slow_scale, rect_.y0, brick.lo[1]),
                                           slice.slow_scale, first, end, slow_count);
                slice.pixels = {columns.first, rows.first, columns.last, rows.last};
                slab.count += slice.pixels.empty() ? 0 : 1;
            }
            if (slab.count > 0) {
                samples_ += composite_slab(slab, classification_.table, rays());
            }
        }
        first = end;
    }
}

template <class Code>
Rays Tile<Code>::rays() {
    return {.r = planes_->r.data(),
            .g = planes_->g.data(),
            .b = planes_->b.data(),
            .a = planes_->a.data(),
            .stride = stride};
}

// Most samples stand for a whole step. Those that do not are at the rim of what the cube covers on a slice.
template <class Code>
const float* Tile<Code>::lengths_on(std::int64_t k, const Rect& pixels, Plane& spare) {
    const Rect inner = intersection(plan_.inside(k - 1), plan_.inside(k + 1));
    const Rect plain = intersection(
        pixels, {inner.x0 - rect_.x0, inner.y0 - rect_.y0, inner.x1 - rect_.x0, inner.y1 - rect_.y0});
    if (plain == pixels) {
        return planes_->steps.data();
    }
    for (int j = pixels.y0; j < pixels.y1; ++j) {
        const auto first = static_cast<std::size_t>(j * stride);
        const float* const steps = &planes_->steps[first];
        float* const lengths = &spare[first];
        const bool plain_row = plain.y0 <= j && j < plain.y1 && plain.x0 < plain.x1;
        const int plain0 = plain_row ? plain.x0 : pixels.x1;
        const int plain1 = plain_row ? plain.x1 : pixels.x1;
        std::copy(steps + plain0, steps + plain1, lengths + plain0);
        for (const auto& [i0, i1] : {std::pair{pixels.x0, plain0}, {plain1, pixels.x1}}) {
            if (i0 < i1) {
                plan_.shares(k, i0 + rect_.x0, j + rect_.y0, {lengths + i0, lengths + i1});
                std::transform(lengths + i0, lengths + i1, steps + i0, lengths + i0, std::multiplies<>());
            }
        }
    }
    return spare.data();
}

template <class Code>
void Tile<Code>::store(image::Window& window) const {
    for (int j = rect_.y0; j < rect_.y1; ++j) {
        for (int i = rect_.x0; i < rect_.x1; ++i) {
            const std::size_t n = slot(i, j);
            const Rect at = plan_.turn({i, j, i, j});
            window.pixels.at(at.x0 - window.rect.x0, at.y0 - window.rect.y0) = {planes_->r[n], planes_->g[n],
                                                                                planes_->b[n], planes_->a[n]};
        }
    }
}

template class Tile<std::uint8_t>;
template class Tile<std::uint16_t>;

}  // namespace shearwater::shear
