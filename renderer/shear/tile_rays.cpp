// What a tile's rays have gathered, and the lengths that their samples stand for.

#include <algorithm>
#include <bit>
#include <functional>
#include <utility>

#include "renderer/shear/ray_pixels.h"
#include "renderer/shear/tile.h"

namespace shearwater::shear {

using view::Rect;

namespace {

// Extinctions of nodes that differ by less than these halvings of light a step are not told apart: as much as
// one opacity in a hundred, at most half of which a sample is wrong by, this way or that.
constexpr float jump_seen = 1.0F / 64;

}  // namespace

// Where the first of them meets something: many tiles' rays meet nothing.
template <class Code>
void Tile<Code>::begin_rays() {
    begun_ = true;
    rims_.fill({});
    for (Plane* const plane : {&planes_->r, &planes_->g, &planes_->b, &planes_->a}) {
        std::fill_n(plane->begin(), rect_.height() * stride, 0.0F);
    }
    const float unit = classification_.segments ? 1 : classification_.table.depth_unit();
    const auto across = static_cast<std::size_t>(rect_.width());
    float longest = 0;
    for (int j = rect_.y0; j < rect_.y1; ++j) {
        const std::span<float> row(&planes_->steps[slot(rect_.x0, j)], across);
        plan_.steps(rect_.x0, j, row);
        for (float& step : row) {
            // Finite, so that times no extinction it is nothing.
            step = std::min(step * unit, 1e38F);
        }
        // A step is the longer the farther its ray moves sideways: the longest is that of an end.
        longest = std::max({longest, row.front(), row.back()});
    }
    between_nodes_ = classification_.table.steepest() * longest > jump_seen;
    // A ray's first sample and its last may stand for two steps.
    faint_ = OpacityTable::largest * 2 * longest <= few_halvings;
}

// Rays that are done stay so: only the rim of what was live has to be looked at.
template <class Code>
void Tile<Code>::narrow_live() {
    const float* const a = planes_->a.data();
    const auto is_live = [a, done = plan_.opaque()](int i, int j) { return a[j * stride + i] < done; };
    const auto any_in = [&](int x0, int y0, int x1, int y1) {
        for (int j = y0; j < y1; ++j) {
            for (int i = x0; i < x1; ++i) {
                if (is_live(i, j)) {
                    return true;
                }
            }
        }
        return false;
    };
    Rect& live = live_;
    while (live.y0 < live.y1 && !any_in(live.x0, live.y0, live.x1, live.y0 + 1)) {
        ++live.y0;
    }
    while (live.y0 < live.y1 && !any_in(live.x0, live.y1 - 1, live.x1, live.y1)) {
        --live.y1;
    }
    while (live.y0 < live.y1 && !any_in(live.x0, live.y0, live.x0 + 1, live.y1)) {
        ++live.x0;
    }
    while (live.y0 < live.y1 && !any_in(live.x1 - 1, live.y0, live.x1, live.y1)) {
        --live.x1;
    }
}

// Whether some ray through pixels of the slices is not done.
template <class Code>
bool Tile<Code>::any_live(Slices slices) const {
    Rect pixels = slices.front().pixels;
    for (const Slice<Code>& slice : slices) {
        pixels = bounding(pixels, slice.pixels);
    }
    const float done = plan_.opaque();
    for (int j = pixels.y0; j < pixels.y1; ++j) {
        const float* const a = &planes_->a[static_cast<std::size_t>(j * stride)];
        // All of a row, for which vectors will do.
        if (std::count_if(a + pixels.x0, a + pixels.x1, [done](float of) { return of < done; }) > 0) {
            return true;
        }
    }
    return false;
}

template <class Code>
Rays Tile<Code>::rays() {
    return {.r = planes_->r.data(),
            .g = planes_->g.data(),
            .b = planes_->b.data(),
            .a = planes_->a.data(),
            .stride = stride,
            .done = plan_.opaque()};
}

// Most samples stand for a whole step. Those that do not are at the rim of what the cube covers on a slice:
// of the n-th plane of lengths, which some slice had before this one, only its rim and that one's are
// written.
template <class Code>
const float* Tile<Code>::lengths_on(std::int64_t k, const Rect& pixels, std::size_t n) {
    const Rect& face_inner = plan_.slice_plan(k).whole;
    const Rect inner{face_inner.x0 - rect_.x0, face_inner.y0 - rect_.y0, face_inner.x1 - rect_.x0,
                     face_inner.y1 - rect_.y0};
    if (intersection(pixels, inner) == pixels) {
        return planes_->steps.data();
    }
    Plane& lengths = planes_->lengths[n];
    const Rims rims = left_over(pixels, inner);
    if (!rims_[n]) {
        copy_steps({0, 0, rect_.width(), rect_.height()}, lengths);
    } else {
        for (std::size_t side = 0; side < rims.size(); ++side) {
            const Rect& before = (*rims_[n])[side];
            if (intersection(before, rims[side]) != before) {
                copy_steps(before, lengths);
            }
        }
    }
    for (const Rect& rim : rims) {
        if (!rim.empty()) {
            plan_.write_shares(k, in_face(rim), lengths_in(lengths));
        }
    }
    rims_[n] = rims;
    return lengths.data();
}

template <class Code>
void Tile<Code>::copy_steps(const Rect& pixels, Plane& to) const {
    constexpr int few = 16;
    if (pixels.width() < few) {
        // Too few for a copy of each row of them.
        for (int i = pixels.x0; i < pixels.x1; ++i) {
            for (int j = pixels.y0; j < pixels.y1; ++j) {
                const auto at = static_cast<std::size_t>(j * stride + i);
                to[at] = planes_->steps[at];
            }
        }
        return;
    }
    for (int j = pixels.y0; j < pixels.y1; ++j) {
        const float* const row = &planes_->steps[static_cast<std::size_t>(j * stride)];
        std::copy(row + pixels.x0, row + pixels.x1, &to[static_cast<std::size_t>(j * stride + pixels.x0)]);
    }
}

// Row j, from pixel (x0, y) of the window on. What is transparent is told by its alpha, a block at a time.
template <class Code>
void Tile<Code>::store_row(int j, const view::Rgb* one_hue, image::Window& window, int x0, int y) {
    constexpr int block = image::LitBlocks::block;
    const auto row = window.pixels.row(y).subspan(static_cast<std::size_t>(x0));
    for (int i = 0; i < rect_.width(); i += block) {
        const int count = std::min(block, rect_.width() - i);
        const auto out = row.subspan(static_cast<std::size_t>(i), static_cast<std::size_t>(count));
        const float* const a = &planes_->a[static_cast<std::size_t>(j * stride + i)];
        std::uint32_t lit = 0;
        for (int n = 0; n < count; ++n) {
            lit |= std::bit_cast<std::uint32_t>(a[n]);
        }
        if (lit == 0) {
            clear_pixels(out);
        } else {
            pixels_of(rays(), j * stride + i, one_hue, out);
            window.lit.light(x0 + i, y);
        }
    }
}

template <class Code>
void Tile<Code>::store(image::Window& window) {
    const OpacityTable& table = classification_.table;
    const view::Rgb hue = table.hue();
    const view::Rgb* const one_hue = table.one_hue() ? &hue : nullptr;
    const Rect at = plan_.turn(rect_);
    const int x0 = at.x0 - window.rect.x0, y0 = at.y0 - window.rect.y0;
    const auto across = static_cast<std::size_t>(rect_.width());
    const Rays gathered = rays();
    if (!plan_.turned()) {
        for (int j = 0; j < rect_.height(); ++j) {
            store_row(j, one_hue, window, x0, y0 + j);
        }
        flush_cleared();
        return;
    }
    // As many rows at a time as lie side by side in a line of the cache.
    constexpr int beside = cache_line / static_cast<int>(sizeof(image::RgbaF));
    std::array<std::array<image::RgbaF, static_cast<std::size_t>(width)>, beside> rows;
    for (int first = 0; first < rect_.height(); first += beside) {
        const int count = std::min(beside, rect_.height() - first);
        for (int n = 0; n < count; ++n) {
            pixels_of(gathered, (first + n) * stride, one_hue,
                      std::span(rows[static_cast<std::size_t>(n)]).first(across));
        }
        for (std::size_t i = 0; i < across; ++i) {
            image::RgbaF* const out = &window.pixels.at(x0 + first, y0 + static_cast<int>(i));
            for (int n = 0; n < count; ++n) {
                out[n] = rows[static_cast<std::size_t>(n)][i];
            }
        }
    }
    for (int y = y0; y < y0 + rect_.width(); ++y) {
        window.lit.note(x0, y,
                        window.pixels.row(y).subspan(static_cast<std::size_t>(x0),
                                                     static_cast<std::size_t>(rect_.height())));
    }
}

template void Tile<std::uint8_t>::begin_rays();
template void Tile<std::uint8_t>::narrow_live();
template bool Tile<std::uint8_t>::any_live(Slices) const;
template Rays Tile<std::uint8_t>::rays();
template const float* Tile<std::uint8_t>::lengths_on(std::int64_t, const Rect&, std::size_t);
template void Tile<std::uint8_t>::copy_steps(const Rect&, Plane&) const;
template void Tile<std::uint8_t>::store_row(int, const view::Rgb*, image::Window&, int, int);
template void Tile<std::uint8_t>::store(image::Window&);
template void Tile<std::uint16_t>::begin_rays();
template void Tile<std::uint16_t>::narrow_live();
template bool Tile<std::uint16_t>::any_live(Slices) const;
template Rays Tile<std::uint16_t>::rays();
template const float* Tile<std::uint16_t>::lengths_on(std::int64_t, const Rect&, std::size_t);
template void Tile<std::uint16_t>::copy_steps(const Rect&, Plane&) const;
template void Tile<std::uint16_t>::store_row(int, const view::Rgb*, image::Window&, int, int);
template void Tile<std::uint16_t>::store(image::Window&);

}  // namespace shearwater::shear
