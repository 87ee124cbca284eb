#include "renderer/shear/tile.h"

#include <algorithm>
#include <cmath>

namespace shearwater::shear {

using view::PixelRange;
using view::Rect;
using view::SliceRange;
using volume::Index3;

// Pixels' samples and voxels on one slice of one brick, both counted from the brick's first voxel.
template <class Code>
struct Tile<Code>::Slab {
    std::int64_t k;
    const Code* codes;
    std::ptrdiff_t u_stride, v_stride;
    int u_cells, v_cells;
    view::SliceMap map;
    bool has_blanks;
    Rect plain;  // the pixels whose sample stands for a whole step
};

template <class Code>
Tile<Code>::Tile(const BrickVolume& volume, std::span<const Code> codes, const FacePlan& plan,
                 const OpacityTable& table, BrickState& state, const Rect& rect)
    : volume_(volume), codes_(codes), plan_(plan), table_(table), state_(state), rect_(rect) {
    for (int j = rect.y0; j < rect.y1; ++j) {
        for (int i = rect.x0; i < rect.x1; ++i) {
            steps_[slot(i, j)] = static_cast<float>(plan.factorisation().step(plan.face(), i, j));
        }
    }
}

template <class Code>
void Tile<Code>::render() {
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
        const float* const a = &a_[slot(rect_.x0, j)];
        if (std::any_of(a, a + rect_.width(), [](float alpha) { return alpha < opaque_enough; })) {
            return false;
        }
    }
    return true;
}

// The columns (or rows) of bricks with samples in [lo, hi) on some of the slices. A voxel plane's place
// in the image changes one way only from slice to slice, so the end slices bound the others.
template <class Code>
std::vector<std::int64_t> Tile<Code>::met(const std::vector<std::int64_t>& places, const SliceRange& slices,
                                          int lo, int hi,
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
    const auto columns = met(plan_.columns(), slices, rect_.x0, rect_.x1, &FacePlan::pixels_of_column);
    const auto rows = met(plan_.rows(), slices, rect_.y0, rect_.y1, &FacePlan::pixels_of_row);
    const view::Face& face = plan_.face();
    Index3 place{};
    place[static_cast<std::size_t>(face.axis)] = layer;
    for (const std::int64_t row : rows) {
        place[static_cast<std::size_t>(face.v_axis())] = row;
        for (const std::int64_t column : columns) {
            place[static_cast<std::size_t>(face.u_axis())] = column;
            render_brick(place, slices, column, row);
        }
    }
}

template <class Code>
void Tile<Code>::render_brick(const Index3& place, const SliceRange& slices, std::int64_t column,
                              std::int64_t row) {
    const Brick& brick = volume_.brick(place[0], place[1], place[2]);
    const auto number = static_cast<std::size_t>(&brick - volume_.bricks().data());
    if (state_.visible[number] == 0) {
        return;
    }
    const std::int64_t count = slices.last - slices.first + 1;
    for (std::int64_t n = 0; n < count; ++n) {
        const std::int64_t k = plan_.face().sign > 0 ? slices.first + n : slices.last - n;
        const PixelRange& u = plan_.pixels_of_column(k, column);
        const PixelRange& v = plan_.pixels_of_row(k, row);
        const Rect pixels = intersection(rect_, {u.first, v.first, u.last, v.last});
        if (!pixels.empty()) {
            state_.rendered[number].store(1, std::memory_order_relaxed);
            render_slice(brick, k, pixels);
        }
    }
}

template <class Code>
void Tile<Code>::render_slice(const Brick& brick, std::int64_t k, const Rect& pixels) {
    const view::Face& face = plan_.face();
    const auto u_axis = static_cast<std::size_t>(face.u_axis());
    const auto v_axis = static_cast<std::size_t>(face.v_axis());
    const auto w_axis = static_cast<std::size_t>(face.axis);
    const volume::Box& box = brick.box;
    const std::array<std::ptrdiff_t, 3> strides = {1, box.planes(0), box.planes(0) * box.planes(1)};

    Slab slab{.k = k,
              .codes = codes_.data() + brick.first + (k - box.lo[w_axis]) * strides[w_axis],
              .u_stride = strides[u_axis],
              .v_stride = strides[v_axis],
              .u_cells = static_cast<int>(box.cells(face.u_axis())),
              .v_cells = static_cast<int>(box.cells(face.v_axis())),
              .map = plan_.factorisation().slice_map(face, static_cast<double>(k)),
              .has_blanks = brick.has_blanks,
              .plain = intersection(plan_.inside(k - 1), plan_.inside(k + 1))};
    slab.map.u_offset -= static_cast<double>(box.lo[u_axis]);
    slab.map.v_offset -= static_cast<double>(box.lo[v_axis]);

    for (int j = pixels.y0; j < pixels.y1; ++j) {
        const bool plain_row = slab.plain.y0 <= j && j < slab.plain.y1;
        const int plain0 = plain_row ? std::clamp(slab.plain.x0, pixels.x0, pixels.x1) : pixels.x1;
        const int plain1 = plain_row ? std::clamp(slab.plain.x1, plain0, pixels.x1) : pixels.x1;
        render_row(slab, j, pixels.x0, plain0);
        render_row(slab, j, plain0, plain1);
        render_row(slab, j, plain1, pixels.x1);
    }
}

// Pixels i0 to i1 are either all plain or none is.
template <class Code>
void Tile<Code>::render_row(const Slab& slab, int j, int i0, int i1) {
    if (i0 >= i1) {
        return;
    }
    const double v = slab.map.v_offset + slab.map.v_scale * j;
    const int cell = std::clamp(static_cast<int>(std::floor(v)), 0, slab.v_cells - 1);
    const Code* const row0 = slab.codes + cell * slab.v_stride;
    const VoxelRows<Code> voxels{.row0 = row0,
                                 .row1 = row0 + slab.v_stride,
                                 .stride = slab.u_stride,
                                 .cells = slab.u_cells,
                                 .v_fraction = static_cast<float>(std::clamp(v - cell, 0.0, 1.0)),
                                 .u = static_cast<float>(slab.map.u_offset + slab.map.u_scale * i0),
                                 .u_scale = static_cast<float>(slab.map.u_scale)};
    const std::size_t first = slot(i0, j);
    const auto count = static_cast<std::size_t>(i1 - i0);
    std::span<const float> lengths(&steps_[first], count);
    std::array<float, side> shares;
    if (!(slab.plain.y0 <= j && j < slab.plain.y1 && slab.plain.x0 <= i0 && i0 < slab.plain.x1)) {
        for (int i = i0; i < i1; ++i) {
            const auto n = static_cast<std::size_t>(i - i0);
            shares[n] = static_cast<float>(plan_.share(slab.k, i, j)) * lengths[n];
        }
        lengths = std::span(shares).first(count);
    }
    const RaySpan rays{&r_[first], &g_[first], &b_[first], &a_[first]};
    samples_ += static_cast<std::uint64_t>(slab.has_blanks
                                               ? composite_span<Code, true>(voxels, lengths, table_, rays)
                                               : composite_span<Code, false>(voxels, lengths, table_, rays));
}

template <class Code>
void Tile<Code>::store(image::Window& window) const {
    for (int j = rect_.y0; j < rect_.y1; ++j) {
        const auto row = window.pixels.row(j - window.rect.y0)
                             .subspan(static_cast<std::size_t>(rect_.x0 - window.rect.x0));
        for (int i = rect_.x0; i < rect_.x1; ++i) {
            const std::size_t n = slot(i, j);
            row[static_cast<std::size_t>(i - rect_.x0)] = {r_[n], g_[n], b_[n], a_[n]};
        }
    }
}

template class Tile<std::uint8_t>;
template class Tile<std::uint16_t>;

}  // namespace shearwater::shear
