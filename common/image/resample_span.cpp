#include "common/image/resample_span.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/image/resample_span.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shearwater::image::HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

std::size_t resample_span(const Layer& layer, const Track& track, int x0, std::span<RgbaF> out,
                          std::span<int> /*left*/) {
    for (std::size_t n = 0; n < out.size(); ++n) {
        out[n] = resample(layer, track.at(x0 + static_cast<double>(n) + 0.5));
    }
    return 0;
}

#else

namespace hn = hwy::HWY_NAMESPACE;

// Pixels are placed and weighed so many at a time; then each is a sum over the 16 about it, whose four rows
// of four are 16 floats each.
constexpr std::size_t batch = 64, part = 16;
struct alignas(64) Batch {
    std::int32_t i[batch], j[batch];                 // the cell
    std::int32_t first[batch], last[batch];          // of the 16, in the window
    float tx[batch], ty[batch];                      // how far into it
    float weight_x[4 * batch], weight_y[4 * batch];  // of a pixel's columns and rows
};

constexpr std::size_t widest = 16;
using Cells = hn::CappedTag<std::int32_t, widest>;
using Floats = hn::CappedTag<float, widest>;
using Doubles = hn::CappedTag<double, widest>;
using Pixel = hn::FixedTag<float, 4>;
#if HWY_HAVE_SCALABLE
using Taps = Pixel;
#else
using Taps = Floats;
#endif

// Places outside the face go to the empty cells about it.
template <class V>
HWY_INLINE void place(V at, int cells, std::int32_t* HWY_RESTRICT cell, float* HWY_RESTRICT into) {
    const Doubles d;
    const auto floor = hn::Floor(at);
    const auto inside = hn::Min(hn::Max(floor, hn::Set(d, -2)), hn::Set(d, cells));
    hn::Store(hn::DemoteTo(hn::Rebind<std::int32_t, Doubles>(), inside), hn::Rebind<std::int32_t, Doubles>(),
              cell);
    hn::Store(hn::DemoteTo(hn::Rebind<float, Doubles>(), hn::Sub(at, floor)), hn::Rebind<float, Doubles>(),
              into);
}

HWY_INLINE void place(const Track& track, double first, const view::Face& face, Batch& b) {
    const Doubles d;
    for (std::size_t n = 0; n < batch; n += hn::Lanes(d)) {
        const auto px = hn::Add(hn::Iota(d, 0), hn::Set(d, first + static_cast<double>(n)));
        const auto along = [&](double start, double step)
                               HWY_ATTR { return hn::MulAdd(px, hn::Set(d, step), hn::Set(d, start)); };
        const auto unit = hn::Div(hn::Set(d, 1), along(track.w, track.w_x));
        const auto rounder = hn::Set(d, Track::rounder);
        const auto i = hn::Sub(hn::MulAdd(along(track.i, track.i_x), unit, rounder), rounder);
        const auto j = hn::Sub(hn::MulAdd(along(track.j, track.j_x), unit, rounder), rounder);
        place(i, face.width, b.i + n, b.tx + n);
        place(j, face.height, b.j + n, b.ty + n);
    }
}

// Catmull-Rom's weights, as cubic_weights of resample.cpp has them, four in a row for each pixel.
HWY_INLINE void weigh(const float* HWY_RESTRICT t, float* HWY_RESTRICT weights) {
    const Floats d;
    const auto half = hn::Set(d, 0.5F), one = hn::Set(d, 1), two = hn::Set(d, 2), three = hn::Set(d, 3);
    for (std::size_t n = 0; n < batch; n += hn::Lanes(d)) {
        const auto x = hn::Load(d, t + n);
        const auto half_x = hn::Mul(half, x), xx = hn::Mul(x, x);
        const auto first = hn::Mul(half_x, hn::MulSub(x, hn::Sub(two, x), one));
        const auto second = hn::Mul(half, hn::MulAdd(xx, hn::MulSub(three, x, hn::Set(d, 5)), two));
        const auto third = hn::Mul(half_x, hn::MulAdd(x, hn::NegMulAdd(three, x, hn::Set(d, 4)), one));
        const auto fourth = hn::Mul(hn::Mul(half_x, x), hn::Sub(x, one));
        hn::StoreInterleaved4(first, second, third, fourth, d, weights + 4 * n);
    }
}

// The weights of the columns from `column` on, each four times over.
HWY_INLINE hn::Vec<Taps> spread(const float* HWY_RESTRICT weight_x, std::size_t column) {
    const Taps d;
    if constexpr (hn::MaxLanes(d) == 4) {
        return hn::Set(d, weight_x[column]);
    } else {
        alignas(64) static constexpr std::int32_t lanes[16] = {0, 0, 0, 0, 1, 1, 1, 1,
                                                               2, 2, 2, 2, 3, 3, 3, 3};
        return hn::TableLookupLanes(hn::LoadDup128(d, weight_x), hn::SetTableIndices(d, lanes + 4 * column));
    }
}

template <class D>
HWY_INLINE hn::Vec<Pixel> sum_of_pixels(D d, hn::Vec<D> v) {
    if constexpr (hn::MaxLanes(d) == 4) {
        return v;
    } else {
        const hn::Half<D> half;
        return sum_of_pixels(half, hn::Add(hn::LowerHalf(half, v), hn::UpperHalf(half, v)));
    }
}

// `taps` is the first of the 16 pixels, `stride` the floats from row to row.
HWY_INLINE void interpolate(const float* HWY_RESTRICT taps, std::ptrdiff_t stride,
                            const float* HWY_RESTRICT weight_x, const float* HWY_RESTRICT weight_y,
                            float* HWY_RESTRICT out) {
    const Taps d;
    const Pixel pixel;
    const auto y0 = hn::Set(d, weight_y[0]), y1 = hn::Set(d, weight_y[1]), y2 = hn::Set(d, weight_y[2]),
               y3 = hn::Set(d, weight_y[3]);
    auto sum = hn::Zero(d);
    for (std::size_t column = 0; column < 4; column += hn::MaxLanes(d) / 4) {
        const float* const top = taps + 4 * column;
        const auto upper = hn::MulAdd(y1, hn::LoadU(d, top + stride), hn::Mul(y0, hn::LoadU(d, top)));
        const auto both = hn::MulAdd(y2, hn::LoadU(d, top + 2 * stride), upper);
        const auto all = hn::MulAdd(y3, hn::LoadU(d, top + 3 * stride), both);
        sum = hn::MulAdd(all, spread(weight_x, column), sum);
    }
    const auto value = hn::Max(sum_of_pixels(d, sum), hn::Zero(pixel));
    const auto alpha = hn::Min(hn::Broadcast<3>(value), hn::Set(pixel, 1));
    hn::StoreU(hn::Min(value, alpha), pixel, out);
}

// Where in the window the first and the last of the 16 pixels are, as far as it has them.
HWY_INLINE void locate(const Window& window, Batch& b) {
    const Cells d;
    const int width = window.rect.width();
    const auto begin = hn::Zero(d), end = hn::Set(d, width * window.rect.height() - 1);
    for (std::size_t n = 0; n < batch; n += hn::Lanes(d)) {
        const auto i = hn::Sub(hn::Load(d, b.i + n), hn::Set(d, window.rect.x0));
        const auto j = hn::Sub(hn::Load(d, b.j + n), hn::Set(d, window.rect.y0));
        const auto at = hn::Add(hn::Mul(j, hn::Set(d, width)), i);
        const auto first = hn::Sub(at, hn::Set(d, width + 1)), last = hn::Add(at, hn::Set(d, 2 * width + 2));
        hn::Store(hn::Min(hn::Max(first, begin), end), d, b.first + n);
        hn::Store(hn::Min(hn::Max(last, begin), end), d, b.last + n);
    }
}

// False only if nothing is to be seen from one point of a track to another: between them i and j only rise or
// only fall. These are not rounded as vectors are, which may make a cell's difference.
HWY_INLINE bool may_be_lit(const Layer& layer, const Place& from, const Place& to) {
    const auto cell = [](double at, int cells) HWY_ATTR {
        return static_cast<int>(std::clamp(std::floor(at), -2.0, static_cast<double>(cells)));
    };
    const view::Face& face = layer.face();
    const int i0 = cell(std::min(from.i, to.i), face.width), i1 = cell(std::max(from.i, to.i), face.width);
    const int j0 = cell(std::min(from.j, to.j), face.height), j1 = cell(std::max(from.j, to.j), face.height);
    return layer.any_lit(i0 - 1, j0 - 1, i1 + 1, j1 + 1);
}

std::size_t resample_span(const Layer& layer, const Track& track, int x0, std::span<RgbaF> out,
                          std::span<int> left) {
    // The way through the window may be down its columns, where the processor does not see what comes next.
    constexpr std::size_t ahead = 12;
    const RgbaF* const pixels = layer.window().pixels.pixels().data();
    const std::ptrdiff_t stride = std::ptrdiff_t{4} * layer.window().rect.width();
    const CellRow* const rows = &layer.cell_row(-Layer::rows_above);
    std::size_t left_over = 0;
    Batch b;
    for (std::size_t begin = 0; begin < out.size(); begin += batch) {
        const std::size_t count = std::min(batch, out.size() - begin);
        const double first = x0 + static_cast<double>(begin) + 0.5;
        if (!may_be_lit(layer, track.at(first), track.at(first + static_cast<double>(count - 1)))) {
            continue;
        }
        place(track, first, layer.face(), b);
        locate(layer.window(), b);
        weigh(b.tx, b.weight_x);
        weigh(b.ty, b.weight_y);
        for (std::size_t n = 0; n < count; ++n) {
            // Much of a batch may be empty too.
            if (n % part == 0) {
                const std::size_t last = std::min(n + part, count) - 1;
                if (!layer.any_lit(b.i[n], b.j[n], b.i[last], b.j[last])) {
                    n = last;
                    continue;
                }
            }
            const std::size_t later = std::min(n + ahead, batch - 1);
            hwy::Prefetch(pixels + b.first[later]);
            hwy::Prefetch(pixels + b.last[later]);
            const CellRow& row = rows[b.j[n] + Layer::rows_above];
            if (row.whole.contains(b.i[n])) {
                interpolate(&pixels[b.first[n]].r, stride, b.weight_x + 4 * n, b.weight_y + 4 * n,
                            &out[begin + n].r);
            } else if (row.lit.contains(b.i[n])) {
                left[left_over++] = static_cast<int>(begin + n);
            }
        }
    }
    return left_over;
}

#endif

}  // namespace
}  // namespace shearwater::image::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shearwater::image {

HWY_EXPORT(resample_span);

std::size_t resample_span(const Layer& layer, const Track& track, int x0, std::span<RgbaF> out,
                          std::span<int> left) {
    return HWY_DYNAMIC_DISPATCH(resample_span)(layer, track, x0, out, left);
}

}  // namespace shearwater::image
#endif
