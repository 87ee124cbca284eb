// The kernel for segments, for whatever vectors the processor has: a row's samples on every slice become
// nodes of the table, each found once, then segments take what lies between two of them.

#include "renderer/shear/segments.h"

#include <algorithm>
#include <array>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/shear/segments.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "renderer/shear/kernel_common-inl.h"
#include "renderer/shear/kernel_samples-inl.h"

HWY_BEFORE_NAMESPACE();
namespace shearwater::shear::HWY_NAMESPACE {

// Of a row of pixels of a chunk: the node of each one's sample on a slice, or `blank_node`; and some node for
// as many as a vector beyond them.
using NodeRow = std::array<std::int32_t, widest_tile + room_for_a_vector>;
inline constexpr std::int32_t blank_node = -1;

// A stretch of a row of pixels.
struct Span {
    int i0, i1;
    bool empty() const { return i1 <= i0; }
};
HWY_INLINE Span within(const view::Rect& pixels, const view::Rect& chunk) {
    return {std::max(pixels.x0, chunk.x0), std::min(pixels.x1, chunk.x1)};
}
HWY_INLINE bool has_row(const view::Rect& pixels, int j) {
    return pixels.y0 <= j && j < pixels.y1;
}

template <bool blanks, class Code>
HWY_INLINE void find_nodes(const Slab<Code>& slab, const Slice<Code>& slice, int j, int width,
                           const Columns& columns, const SegmentTable& table, std::int32_t* nodes) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> di;
    Row row;
    interpolate_row<blanks>(slab, slice, j, columns, row);
    int n = 0;
    for (; n < width; n += static_cast<int>(hn::Lanes(d))) {
        const auto at = static_cast<std::size_t>(n);
        const auto along = [&](const float* values)
                               HWY_ATTR { return interpolate_along(d, values, columns, at); };
        const auto node_of = [&](hn::Vec<decltype(d)> code) HWY_ATTR {
            return hn::ConvertTo(di, hn::MulAdd(code, hn::Set(d, table.nodes_per_code()), hn::Set(d, 0.5F)));
        };
        const auto code = along(row.codes.data());
        if constexpr (blanks) {
            const auto valid = along(row.valid.data());
            const auto enough = hn::Ge(valid, hn::Set(d, least_valid));
            const auto node = node_of(hn::IfThenElseZero(enough, mean_of_valid(d, code, valid)));
            hn::StoreU(hn::IfThenElse(hn::RebindMask(di, enough), node, hn::Set(di, blank_node)), di,
                       nodes + n);
        } else {
            hn::StoreU(node_of(code), di, nodes + n);
        }
    }
    hn::StoreU(hn::Zero(di), di, nodes + n);
}

// A row of segments, in whole vectors. In steps that each go over all of it: what is stored in parts of a
// vector is not to be loaded as a whole at once.
struct SegmentRow {
    static constexpr std::size_t room = widest_tile + room_for_a_vector;

    alignas(64) std::array<std::int32_t, room> from, to;  // nodes, not alike
    alignas(64) std::array<float, room> weights;          // how much of the length counts: 0, 1/2 or 1
    alignas(64) std::array<float, 4 * room> sums;         // of depth, r, g and b between the nodes
};

template <bool blanks>
HWY_INLINE void find_ends(const std::int32_t* front, const std::int32_t* back, int width, SegmentRow& row) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> di;
    for (int n = 0; n < width; n += static_cast<int>(hn::Lanes(d))) {
        const auto at = static_cast<std::size_t>(n);
        auto from = hn::LoadU(di, front + n);
        auto to = hn::LoadU(di, back + n);
        if constexpr (blanks) {
            const auto half = hn::Set(d, 0.5F);
            const auto has_from = hn::Ne(from, hn::Set(di, blank_node));
            const auto has_to = hn::Ne(to, hn::Set(di, blank_node));
            hn::Store(hn::Add(hn::IfThenElseZero(hn::RebindMask(d, has_from), half),
                              hn::IfThenElseZero(hn::RebindMask(d, has_to), half)),
                      d, &row.weights[at]);
            const auto either = hn::IfThenElse(has_from, from, hn::IfThenElseZero(has_to, to));
            to = hn::IfThenElse(has_to, to, either);
            from = either;
        }
        const auto apart = hn::IfThenElseZero(hn::Eq(from, to), hn::Set(di, 1));
        hn::Store(hn::Sub(from, apart), di, &row.from[at]);
        hn::Store(hn::Add(to, apart), di, &row.to[at]);
    }
}

// Two nodes are near one another as a rule, and are read whole: cheaper than a gather for every channel.
HWY_INLINE void sum_between(const SegmentTable& table, int width, SegmentRow& row) {
    const hn::CappedTag<float, 4> channels;
    const float* const nodes = &table.nodes()->depth;
    const std::size_t lanes = hn::Lanes(hn::ScalableTag<float>());
    const std::size_t count = (static_cast<std::size_t>(width) + lanes - 1) / lanes * lanes;
    for (std::size_t n = 0; n < count; ++n) {
        const float* const from = nodes + std::ptrdiff_t{row.from[n]} * 8;
        const float* const to = nodes + std::ptrdiff_t{row.to[n]} * 8;
        for (std::size_t c = 0; c < 4; c += hn::Lanes(channels)) {
            const auto whole = hn::Sub(hn::Load(channels, to + c), hn::Load(channels, from + c));
            const auto rest = hn::Sub(hn::Load(channels, to + 4 + c), hn::Load(channels, from + 4 + c));
            hn::Store(hn::Add(whole, rest), channels, &row.sums[4 * n + c]);
        }
    }
}

// The pixels of a span of row j of a segment. a_before: of those pixels.
template <bool blanks>
HWY_INLINE std::uint64_t composite_row_of_segments(const Segment& segment, const Span& span, int j,
                                                   const SegmentRow& row, const float* a_before,
                                                   const Rays& rays) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> di;
    const auto zero = hn::Zero(d);
    std::uint64_t taken = 0;
    const int width = span.i1 - span.i0;
    for (int n = 0; n < width; n += static_cast<int>(hn::Lanes(d))) {
        const auto at = static_cast<std::size_t>(n);
        const auto live = hn::And(hn::FirstN(d, static_cast<std::size_t>(width - n)),
                                  hn::Lt(hn::LoadU(d, a_before + n), hn::Set(d, rays.done)));
        taken += hn::CountTrue(d, live);
        const std::ptrdiff_t ray = j * rays.stride + span.i0 + n;
        auto length = hn::IfThenElseZero(live, hn::LoadU(d, segment.lengths + ray));
        if constexpr (blanks) {
            length = hn::Mul(length, hn::Load(d, &row.weights[at]));
        }
        hn::Vec<decltype(d)> sum, r, g, b;
        hn::LoadInterleaved4(d, &row.sums[4 * at], sum, r, g, b);
        const auto nodes = hn::ConvertTo(d, hn::Sub(hn::Load(di, &row.to[at]), hn::Load(di, &row.from[at])));
        const auto depth = hn::Mul(hn::Max(hn::Div(sum, nodes), zero), length);
        const auto seen = hn::Gt(depth, zero);
        if (hn::AllFalse(d, seen)) {
            continue;
        }
        const auto share = hn::IfThenElseZero(seen, hn::Div(hn::Set(d, 1.0F), sum));
        Gathered<decltype(d)> gathered(d, rays, ray);
        gathered.put_behind(hn::IfThenElseZero(seen, opacity_of_halvings(d, depth)), hn::Mul(r, share),
                            hn::Mul(g, share), hn::Mul(b, share));
        gathered.store(d, rays, ray);
    }
    return taken;
}

// The pixels of a chunk.
template <bool blanks, class Code>
std::uint64_t composite_segments_of_chunk(const SegmentSlab<Code>& slab, const view::Rect& chunk,
                                          const SegmentTable& table, const Rays& rays, Fetching& fetching) {
    const Slab<Code>& samples = slab.samples;
    const auto slices = static_cast<std::size_t>(samples.count);
    std::array<Columns, Slab<Code>::max_ends> columns;
    std::array<Span, Slab<Code>::max_ends> spans;
    std::array<NodeRow, Slab<Code>::max_ends> nodes;
    for (std::size_t k = 0; k < slices; ++k) {
        spans[k] = within(samples.slices[k].pixels, chunk);
        if (!spans[k].empty()) {
            lay_columns(samples, samples.slices[k], spans[k].i0, spans[k].i1, columns[k]);
        }
    }
    std::array<float, widest_tile + ray_padding> a_before;
    SegmentRow row;
    std::uint64_t taken = 0;
    for (int j = chunk.y0; j < chunk.y1; ++j) {
        fetching.step<Into::second>();
        const float* const a = rays.a + j * rays.stride;
        if (std::all_of(a + chunk.x0, a + chunk.x1, [&](float alpha) { return alpha >= rays.done; })) {
            continue;
        }
        std::copy_n(a, a_before.size(), a_before.begin());
        for (std::size_t k = 0; k < slices; ++k) {
            if (!spans[k].empty() && has_row(samples.slices[k].pixels, j)) {
                find_nodes<blanks>(samples, samples.slices[k], j, spans[k].i1 - spans[k].i0, columns[k],
                                   table, nodes[k].data());
            }
        }
        for (std::size_t n = 0; n < static_cast<std::size_t>(slab.count); ++n) {
            const Segment& segment = slab.segments[n];
            const Span span = within(segment.pixels, chunk);
            if (!span.empty() && has_row(segment.pixels, j)) {
                const auto at = [&](int slice) {
                    const auto k = static_cast<std::size_t>(slice);
                    return &nodes[k][static_cast<std::size_t>(span.i0 - spans[k].i0)];
                };
                find_ends<blanks>(at(segment.front), at(segment.back), span.i1 - span.i0, row);
                sum_between(table, span.i1 - span.i0, row);
                taken +=
                    composite_row_of_segments<blanks>(segment, span, j, row, a_before.data() + span.i0, rays);
            }
        }
    }
    return taken;
}

template <class Code>
HWY_INLINE std::uint64_t composite_all_segments(const SegmentSlab<Code>& slab, const SegmentTable& table,
                                                const Rays& rays) {
    const int most = pixels_of_a_chunk(slab.samples);
    const view::Rect pixels = pixels_of(slab.samples);
    Fetching fetching(slab.samples.ahead, (pixels.width() + most - 1) / most * pixels.height());
    std::uint64_t taken = 0;
    for (int i = pixels.x0; i < pixels.x1; i += most) {
        const view::Rect chunk{i, pixels.y0, std::min(i + most, pixels.x1), pixels.y1};
        taken += slab.samples.blanks ? composite_segments_of_chunk<true>(slab, chunk, table, rays, fetching)
                                     : composite_segments_of_chunk<false>(slab, chunk, table, rays, fetching);
    }
    return taken;
}

std::uint64_t composite_segments_8(const SegmentSlab<std::uint8_t>& slab, const SegmentTable& table,
                                   const Rays& rays) {
    return composite_all_segments(slab, table, rays);
}

std::uint64_t composite_segments_16(const SegmentSlab<std::uint16_t>& slab, const SegmentTable& table,
                                    const Rays& rays) {
    return composite_all_segments(slab, table, rays);
}

}  // namespace shearwater::shear::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shearwater::shear {

HWY_EXPORT(composite_segments_8);
HWY_EXPORT(composite_segments_16);

template <>
std::uint64_t composite_segments(const SegmentSlab<std::uint8_t>& slab, const SegmentTable& table,
                                 const Rays& rays) {
    return HWY_DYNAMIC_DISPATCH(composite_segments_8)(slab, table, rays);
}

template <>
std::uint64_t composite_segments(const SegmentSlab<std::uint16_t>& slab, const SegmentTable& table,
                                 const Rays& rays) {
    return HWY_DYNAMIC_DISPATCH(composite_segments_16)(slab, table, rays);
}

}  // namespace shearwater::shear
#endif
