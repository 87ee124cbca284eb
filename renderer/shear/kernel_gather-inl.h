// Per target: the kernel for any code, with blanks or without. Rows of voxels are first interpolated across
// into a row of floats; samples then gather from it, and from the opacity table.
#if defined(SHEARWATER_SHEAR_KERNEL_GATHER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SHEARWATER_SHEAR_KERNEL_GATHER_INL_H
#undef SHEARWATER_SHEAR_KERNEL_GATHER_INL_H
#else
#define SHEARWATER_SHEAR_KERNEL_GATHER_INL_H
#endif

#include "renderer/shear/kernel_common-inl.h"

HWY_BEFORE_NAMESPACE();
namespace shearwater::shear::HWY_NAMESPACE {

// Pixels of a chunk and voxels of a row, with room for a vector more.
inline constexpr int room_for_a_vector = 16;
inline constexpr int most_voxels = 128;
inline constexpr int longest_row = most_voxels + room_for_a_vector;

// The same for all rows of pixels of a slice: which voxels of the row a pixel lies between.
struct Columns {
    alignas(64) std::array<std::int32_t, longest_row> cells;
    alignas(64) std::array<float, longest_row> fractions;
    std::int64_t first_voxel;  // that is needed of a row
    int voxels;
};

template <class Code>
HWY_INLINE void lay_columns(const Slab<Code>& slab, const Slice<Code>& slice, int i0, int i1,
                            Columns& columns) {
    const auto place = [&](int i) {
        return place_of(along_row(slice, i + slab.fast_pixel), slab.fast_first);
    };
    const std::int64_t least = std::min(place(i0).cell, place(i1 - 1).cell);
    const std::int64_t greatest = std::max(place(i0).cell, place(i1 - 1).cell);
    columns.first_voxel = least;
    columns.voxels = static_cast<int>(greatest - least) + 2;
    for (int i = i0; i < i1; ++i) {
        const CellPlace at = place(i);
        columns.cells[static_cast<std::size_t>(i - i0)] = static_cast<std::int32_t>(at.cell - least);
        columns.fractions[static_cast<std::size_t>(i - i0)] = static_cast<float>(at.step) / cell_steps;
    }
    // What a vector reaches beyond them lies nowhere in particular.
    std::fill_n(&columns.cells[static_cast<std::size_t>(i1 - i0)], room_for_a_vector, 0);
    std::fill_n(&columns.fractions[static_cast<std::size_t>(i1 - i0)], room_for_a_vector, 0.0F);
}

// A vector of pixels' values from the `at`-th on, of those of a row of voxels.
template <class D>
HWY_INLINE hn::Vec<D> interpolate_along(D d, const float* values, const Columns& columns, std::size_t at) {
    const auto cell = hn::Load(hn::RebindToSigned<D>(), &columns.cells[at]);
    const auto left = hn::GatherIndex(d, values, cell);
    const auto right = hn::GatherIndex(d, values + 1, cell);
    return hn::MulAdd(hn::Load(d, &columns.fractions[at]), hn::Sub(right, left), left);
}

template <class D, class Code>
HWY_INLINE hn::Vec<D> load_codes(D d, const Code* codes) {
    const hn::RebindToSigned<D> di;
    return hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(hn::Rebind<Code, D>(), codes)));
}

// A row of voxels interpolated across the slow axis, and how much of each is valid.
struct Row {
    alignas(64) std::array<float, longest_row> codes;
    alignas(64) std::array<float, longest_row> valid;
};

template <bool blanks, class Code>
HWY_INLINE void interpolate_across(const Code* plane, std::ptrdiff_t stride, float fraction, float weight,
                                   int voxels, bool add, Row& row) {
    const hn::ScalableTag<float> d;
    const auto weight1 = hn::Set(d, weight * fraction);
    const auto weight0 = hn::Set(d, weight * (1 - fraction));
    const auto zero = hn::Zero(d);
    for (int n = 0; n < voxels; n += static_cast<int>(hn::Lanes(d))) {
        const auto at = static_cast<std::size_t>(n);
        const auto code0 = load_codes(d, plane + n);
        const auto code1 = load_codes(d, plane + stride + n);
        const auto before = add ? hn::Load(d, &row.codes[at]) : zero;
        hn::Store(hn::MulAdd(code1, weight1, hn::MulAdd(code0, weight0, before)), d, &row.codes[at]);
        if constexpr (blanks) {
            const auto valid0 = hn::IfThenElseZero(hn::Ne(code0, zero), weight0);
            const auto valid1 = hn::IfThenElseZero(hn::Ne(code1, zero), weight1);
            const auto valid_before = add ? hn::Load(d, &row.valid[at]) : zero;
            hn::Store(hn::Add(valid_before, hn::Add(valid0, valid1)), d, &row.valid[at]);
        }
    }
}

template <bool blanks, class Code>
HWY_INLINE void interpolate_row(const Slab<Code>& slab, const Slice<Code>& slice, int j,
                                const Columns& columns, Row& row) {
    const CellPlace place = row_place(slab, slice, j);
    const auto fraction = static_cast<float>(place.step) / cell_steps;
    const float weight = slice.next == nullptr ? 1 : 0.5F;
    const std::ptrdiff_t from = place.cell * slab.stride + columns.first_voxel;
    interpolate_across<blanks>(slice.voxels + from, slab.stride, fraction, weight, columns.voxels, false,
                               row);
    if (slice.next != nullptr) {
        interpolate_across<blanks>(slice.next + from, slab.stride, fraction, weight, columns.voxels, true,
                                   row);
    }
}

// One row of the pixels [i0, i1) of one slice. a_before: of the row's rays, from i0 on, before the slab.
template <bool blanks, class Code>
HWY_INLINE std::uint64_t composite_row(const Slab<Code>& slab, const Slice<Code>& slice, int i0, int i1,
                                       int j, const Columns& columns, const OpacityTable& table,
                                       const float* a_before, const Rays& rays) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> di;
    const float* const nodes = &table.nodes()->r;
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
            code = hn::IfThenElseZero(enough, hn::Div(code, valid));
        }
        const auto place = hn::Mul(code, hn::Set(d, table.nodes_per_code()));
        const auto below = hn::Floor(place);
        const auto beyond = hn::Sub(place, below);
        const auto node = hn::ShiftLeft<2>(hn::ConvertTo(di, below));
        const auto left = hn::GatherIndex(d, nodes + 3, node);
        const auto right = hn::GatherIndex(d, nodes + 7, node);
        const std::ptrdiff_t ray = j * rays.stride + i0 + n;
        const auto length = hn::IfThenElseZero(live, hn::LoadU(d, slice.lengths + ray));
        const auto depth = hn::Mul(hn::MulAdd(beyond, hn::Sub(right, left), left), length);
        if (hn::AllFalse(d, hn::Gt(depth, hn::Zero(d)))) {
            continue;
        }
        const auto upper = hn::RebindMask(di, hn::Ge(beyond, hn::Set(d, 0.5F)));
        const auto nearest = hn::Add(node, hn::IfThenElseZero(upper, hn::Set(di, 4)));
        Gathered<decltype(d)> gathered(d, rays, ray);
        gathered.put_behind(opacity_of_halvings(d, depth), hn::GatherIndex(d, nodes, nearest),
                            hn::GatherIndex(d, nodes + 1, nearest), hn::GatherIndex(d, nodes + 2, nearest));
        gathered.store(d, rays, ray);
    }
    return taken;
}

// The pixels of a chunk, from i0 to i1 at most.
template <bool blanks, class Code>
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
    std::array<float, widest_tile + ray_padding> a_before;
    std::uint64_t taken = 0;
    for (int j = chunk.y0; j < chunk.y1; ++j) {
        fetching.step();
        std::copy_n(rays.a + j * rays.stride, a_before.size(), a_before.begin());
        for (std::size_t k = 0; k < static_cast<std::size_t>(slab.count); ++k) {
            const Slice<Code>& slice = slab.slices[k];
            const auto [i0, i1] = spans[k];
            if (i0 < i1 && slice.pixels.y0 <= j && j < slice.pixels.y1) {
                taken += composite_row<blanks>(slab, slice, i0, i1, j, columns[k], table,
                                               a_before.data() + i0, rays);
            }
        }
    }
    return taken;
}

// So many pixels lie, on every slice, within the row of voxels that there is room for.
template <class Code>
HWY_INLINE int pixels_of_a_chunk(const Slab<Code>& slab) {
    double scale = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(slab.count); ++k) {
        scale = std::max(scale, std::abs(slab.slices[k].fast_scale));
    }
    const double room = (most_voxels - 3) / scale;
    return room >= widest_tile ? widest_tile : std::max(1, static_cast<int>(room));
}

template <bool blanks, class Code>
std::uint64_t composite_gathering(const Slab<Code>& slab, const OpacityTable& table, const Rays& rays) {
    const int most = pixels_of_a_chunk(slab);
    const view::Rect pixels = pixels_of(slab);
    Fetching fetching(slab.ahead, (pixels.width() + most - 1) / most * pixels.height());
    std::uint64_t taken = 0;
    for (int i = pixels.x0; i < pixels.x1; i += most) {
        taken += composite_chunk<blanks>(slab, {i, pixels.y0, std::min(i + most, pixels.x1), pixels.y1},
                                         table, rays, fetching);
    }
    return taken;
}

}  // namespace shearwater::shear::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
