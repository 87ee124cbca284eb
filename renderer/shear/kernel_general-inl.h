// Per target: the kernel for any code, with blanks or without. Samples of a row are interpolated, then their
// nodes of the opacity table read and put behind the rays.
#if defined(SHEARWATER_SHEAR_KERNEL_GENERAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SHEARWATER_SHEAR_KERNEL_GENERAL_INL_H
#undef SHEARWATER_SHEAR_KERNEL_GENERAL_INL_H
#else
#define SHEARWATER_SHEAR_KERNEL_GENERAL_INL_H
#endif

#include "renderer/shear/kernel_common-inl.h"
#include "renderer/shear/kernel_samples-inl.h"

HWY_BEFORE_NAMESPACE();
namespace shearwater::shear::HWY_NAMESPACE {

// Nodes of a table, channel by channel.
template <class D>
struct Nodes {
    hn::Vec<D> r, g, b, extinction;
};

#if HWY_TARGET == HWY_SCALAR
// The nodes at some indices, counted in floats.
template <class D>
HWY_INLINE Nodes<D> load_nodes(D d, const float* nodes, hn::Vec<hn::RebindToSigned<D>> index) {
    return {hn::GatherIndex(d, nodes, index), hn::GatherIndex(d, nodes + 1, index),
            hn::GatherIndex(d, nodes + 2, index), hn::GatherIndex(d, nodes + 3, index)};
}
#else
// Blocks of four floats, one in each of a vector's: from those at every fourth of some indices on.
template <class D>
HWY_INLINE hn::Vec<D> load_blocks(D d, const float* from, const std::int32_t* index) {
    if constexpr (sizeof(hn::Vec<D>) == 4 * sizeof(float)) {
        return hn::LoadU(d, from + *index);
    } else {
        const hn::Half<D> half;
        return hn::Combine(d, load_blocks(half, from, index + hn::Lanes(half)),
                           load_blocks(half, from, index));
    }
}

// The nodes at some indices, counted in floats. A node is read whole: gathering would read it by channels.
template <class D>
HWY_INLINE Nodes<D> load_nodes(D d, const float* nodes, hn::Vec<hn::RebindToSigned<D>> index) {
    const hn::Repartition<double, D> pairs;
    alignas(64) std::array<std::int32_t, sizeof(hn::Vec<D>) / sizeof(float)> at;
    hn::Store(index, hn::RebindToSigned<D>(), at.data());
    // Each block has r g b e of one pixel of four: to be turned.
    const auto n0 = load_blocks(d, nodes, &at[0]), n1 = load_blocks(d, nodes, &at[1]);
    const auto n2 = load_blocks(d, nodes, &at[2]), n3 = load_blocks(d, nodes, &at[3]);
    const auto rg01 = hn::BitCast(pairs, hn::InterleaveLower(d, n0, n1));
    const auto rg23 = hn::BitCast(pairs, hn::InterleaveLower(d, n2, n3));
    const auto be01 = hn::BitCast(pairs, hn::InterleaveUpper(d, n0, n1));
    const auto be23 = hn::BitCast(pairs, hn::InterleaveUpper(d, n2, n3));
    return {hn::BitCast(d, hn::InterleaveLower(pairs, rg01, rg23)),
            hn::BitCast(d, hn::InterleaveUpper(pairs, rg01, rg23)),
            hn::BitCast(d, hn::InterleaveLower(pairs, be01, be23)),
            hn::BitCast(d, hn::InterleaveUpper(pairs, be01, be23))};
}
#endif

// The nearest nodes, and where it is to be interpolated the extinction between those on either side.
template <bool between_nodes, class D>
HWY_INLINE Nodes<D> nodes_at(D d, const float* nodes, hn::Vec<D> place) {
    const hn::RebindToSigned<D> di;
    if constexpr (!between_nodes) {
        const auto nearest = hn::ConvertTo(di, hn::Add(place, hn::Set(d, 0.5F)));
        return load_nodes(d, nodes, hn::ShiftLeft<2>(nearest));
    }
    const auto below = hn::ConvertTo(di, place);
    const auto beyond = hn::Sub(place, hn::ConvertTo(d, below));
    const auto index = hn::ShiftLeft<2>(below);
    const Nodes<D> left = load_nodes(d, nodes, index), right = load_nodes(d, nodes + 4, index);
    const auto is_left = hn::Lt(beyond, hn::Set(d, 0.5F));
    return {hn::IfThenElse(is_left, left.r, right.r), hn::IfThenElse(is_left, left.g, right.g),
            hn::IfThenElse(is_left, left.b, right.b),
            hn::MulAdd(beyond, hn::Sub(right.extinction, left.extinction), left.extinction)};
}

// What a row needs of the table for all its vectors.
struct Lookup {
    const OpacityTable& table;
    bool faint;
    float before_opaque, behind_opaque;  // nodes: what is not between them has no opacity

    Lookup(const OpacityTable& of, bool few)
        : table(of),
          faint(few),
          before_opaque(static_cast<float>(of.first_opaque() - 1)),
          behind_opaque(static_cast<float>(of.last_opaque() + 1)) {}
};

// One row of the pixels [i0, i1) of one slice. a_before: of the row's rays, from i0 on, before the slab.
template <bool blanks, bool between_nodes, bool one_hue, class Code>
HWY_INLINE std::uint64_t composite_row(const Slab<Code>& slab, const Slice<Code>& slice, int i0, int i1,
                                       int j, const Columns& columns, const Lookup& lookup,
                                       const float* a_before, const Rays& rays) {
    const hn::ScalableTag<float> d;
    const float* const nodes = &lookup.table.nodes()->r;
    Row row;
    interpolate_row<blanks>(slab, slice, j, columns, row);
    std::uint64_t taken = 0;
    const int width = i1 - i0;
    for (int n = 0; n < width; n += static_cast<int>(hn::Lanes(d))) {
        const auto at = static_cast<std::size_t>(n);
        auto live = hn::And(hn::FirstN(d, static_cast<std::size_t>(width - n)),
                            hn::Lt(hn::LoadU(d, a_before + n), hn::Set(d, rays.done)));
        if (hn::AllFalse(d, live)) {
            continue;
        }
        taken += hn::CountTrue(d, live);
        const auto along = [&](const float* values)
                               HWY_ATTR { return interpolate_along(d, values, columns, at); };
        auto code = along(row.codes.data());
        if constexpr (blanks) {
            const auto valid = along(row.valid.data());
            const auto enough = hn::Ge(valid, hn::Set(d, least_valid));
            live = hn::And(live, enough);
            code = hn::IfThenElseZero(enough, mean_of_valid(d, code, valid));
        }
        const auto place = hn::Mul(code, hn::Set(d, lookup.table.nodes_per_code()));
        live = hn::And(live, hn::And(hn::Gt(place, hn::Set(d, lookup.before_opaque)),
                                     hn::Lt(place, hn::Set(d, lookup.behind_opaque))));
        if (hn::AllFalse(d, live)) {
            continue;
        }
        const auto node = nodes_at<between_nodes>(d, nodes, place);
        const std::ptrdiff_t ray = j * rays.stride + i0 + n;
        const auto depth =
            hn::Mul(node.extinction, hn::IfThenElseZero(live, hn::LoadU(d, slice.lengths + ray)));
        const auto alpha = lookup.faint ? opacity_of_few_halvings(d, depth) : opacity_of_halvings(d, depth);
        Gathered<decltype(d), one_hue> gathered(d, rays, ray);
        gathered.put_behind(alpha, node.r, node.g, node.b);
        gathered.store(d, rays, ray);
    }
    return taken;
}

// The pixels of a chunk, from i0 to i1 at most.
template <bool blanks, bool between_nodes, bool one_hue, class Code>
std::uint64_t composite_chunk(const Slab<Code>& slab, const view::Rect& chunk, const OpacityTable& table,
                              const Rays& rays, Fetching& fetching) {
    struct Span {
        int i0, i1;
    };
    std::array<Columns, Slab<Code>::max_slices> columns;
    std::array<Span, Slab<Code>::max_slices> spans;
    for (std::size_t k = 0; k < static_cast<std::size_t>(slab.count); ++k) {
        const view::Rect& pixels = slab.slices[k].pixels;
        spans[k] = {std::max(pixels.x0, chunk.x0), std::min(pixels.x1, chunk.x1)};
        if (spans[k].i0 < spans[k].i1) {
            lay_columns(slab, slab.slices[k], spans[k].i0, spans[k].i1, columns[k]);
        }
    }
    const Lookup lookup(table, slab.faint);
    std::array<float, widest_tile + ray_padding> a_before;
    std::uint64_t taken = 0;
    for (int j = chunk.y0; j < chunk.y1; ++j) {
        fetching.step<Into::second>();
        std::copy_n(rays.a + j * rays.stride, a_before.size(), a_before.begin());
        for (std::size_t k = 0; k < static_cast<std::size_t>(slab.count); ++k) {
            const Slice<Code>& slice = slab.slices[k];
            const auto [i0, i1] = spans[k];
            if (i0 < i1 && slice.pixels.y0 <= j && j < slice.pixels.y1) {
                taken += composite_row<blanks, between_nodes, one_hue>(slab, slice, i0, i1, j, columns[k],
                                                                       lookup, a_before.data() + i0, rays);
            }
        }
    }
    return taken;
}

template <bool blanks, bool between_nodes, bool one_hue, class Code>
std::uint64_t composite_chunks(const Slab<Code>& slab, const OpacityTable& table, const Rays& rays) {
    const int most = pixels_of_a_chunk(slab);
    const view::Rect pixels = pixels_of(slab);
    Fetching fetching(slab.ahead, (pixels.width() + most - 1) / most * pixels.height());
    std::uint64_t taken = 0;
    for (int i = pixels.x0; i < pixels.x1; i += most) {
        taken += composite_chunk<blanks, between_nodes, one_hue>(
            slab, {i, pixels.y0, std::min(i + most, pixels.x1), pixels.y1}, table, rays, fetching);
    }
    return taken;
}

template <bool blanks, class Code>
std::uint64_t composite_in_general(const Slab<Code>& slab, const OpacityTable& table, const Rays& rays) {
    if (table.one_hue()) {
        return slab.between_nodes ? composite_chunks<blanks, true, true>(slab, table, rays)
                                  : composite_chunks<blanks, false, true>(slab, table, rays);
    }
    return slab.between_nodes ? composite_chunks<blanks, true, false>(slab, table, rays)
                              : composite_chunks<blanks, false, false>(slab, table, rays);
}

}  // namespace shearwater::shear::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
