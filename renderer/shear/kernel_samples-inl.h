// Per target, for any code, with blanks or without: rows of voxels are interpolated across into a row of
// floats, and samples from it along.
#if defined(SHEARWATER_SHEAR_KERNEL_SAMPLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SHEARWATER_SHEAR_KERNEL_SAMPLES_INL_H
#undef SHEARWATER_SHEAR_KERNEL_SAMPLES_INL_H
#else
#define SHEARWATER_SHEAR_KERNEL_SAMPLES_INL_H
#endif

#include "renderer/shear/kernel_common-inl.h"

HWY_BEFORE_NAMESPACE();
namespace shearwater::shear::HWY_NAMESPACE {

// Pixels of a chunk and voxels of a row, with room for two vectors more and a value.
inline constexpr int room_for_a_vector = 16;
inline constexpr int most_voxels = 128;
inline constexpr int longest_row = most_voxels + 3 * room_for_a_vector;

// The same for all rows of pixels of a slice: which voxels of the row a pixel lies between.
struct Columns {
    // How far a vector's pixels reach over the row: what lies within one vector of its values, or two, is
    // looked up in registers, which takes a fraction of what gathering does.
    enum class Reach { one, two, far };

    alignas(64) std::array<std::int32_t, longest_row> cells;  // from their vector's first, or from the row's
    alignas(64) std::array<float, longest_row> fractions;
    std::array<std::int32_t, widest_tile> first_cells;  // of vectors, where their first pixels are
    std::int64_t first_voxel;                           // that is needed of a row
    int voxels;
    Reach reach;
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
    const auto count = static_cast<std::size_t>(i1 - i0);
    for (std::size_t n = 0; n < count; ++n) {
        const CellPlace at = place(i0 + static_cast<int>(n));
        columns.cells[n] = static_cast<std::int32_t>(at.cell - least);
        columns.fractions[n] = static_cast<float>(at.step) / cell_steps;
    }
    // What a vector reaches beyond them lies where the last does.
    std::fill_n(&columns.cells[count], room_for_a_vector, columns.cells[count - 1]);
    std::fill_n(&columns.fractions[count], room_for_a_vector, 0.0F);

    const std::size_t lanes = hn::Lanes(hn::ScalableTag<float>());
    std::int32_t farthest = 0;
    for (std::size_t n = 0; n < count; n += lanes) {
        const auto [near, far] = std::minmax(columns.cells[n], columns.cells[n + lanes - 1]);
        columns.first_cells[n] = near;
        farthest = std::max(farthest, far - near);
    }
    const auto within = static_cast<std::int32_t>(lanes);
    columns.reach = farthest < within       ? Columns::Reach::one
                    : farthest < 2 * within ? Columns::Reach::two
                                            : Columns::Reach::far;
    if (columns.reach != Columns::Reach::far) {
        for (std::size_t n = 0; n < count; ++n) {
            columns.cells[n] -= columns.first_cells[n / lanes * lanes];
        }
        std::fill_n(&columns.cells[count], room_for_a_vector, 0);
    }
}

// Of the values from one on: that at each index, less than two vectors' lanes, or than one's.
template <bool one, class D>
HWY_INLINE hn::Vec<D> look_up(D d, const float* values, hn::Vec<hn::RebindToSigned<D>> index) {
    const hn::RebindToSigned<D> di;
    const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
    if constexpr (one) {
        return hn::TableLookupLanes(hn::LoadU(d, values), hn::IndicesFromVec(d, index));
    }
    const auto beyond = hn::Gt(index, hn::Set(di, lanes - 1));
    const auto within = hn::IndicesFromVec(d, hn::And(index, hn::Set(di, lanes - 1)));
    return hn::IfThenElse(hn::RebindMask(d, beyond),
                          hn::TableLookupLanes(hn::LoadU(d, values + lanes), within),
                          hn::TableLookupLanes(hn::LoadU(d, values), within));
}

// A vector of pixels' values from the `at`-th on, of those of a row of voxels.
template <class D>
HWY_INLINE hn::Vec<D> interpolate_along(D d, const float* values, const Columns& columns, std::size_t at) {
    const auto cell = hn::Load(hn::RebindToSigned<D>(), &columns.cells[at]);
    const auto fraction = hn::Load(d, &columns.fractions[at]);
    const auto between = [&](hn::Vec<D> left, hn::Vec<D> right)
                             HWY_ATTR { return hn::MulAdd(fraction, hn::Sub(right, left), left); };
    const float* const first = values + columns.first_cells[at];
    if (columns.reach == Columns::Reach::one) {
        return between(look_up<true>(d, first, cell), look_up<true>(d, first + 1, cell));
    }
    if (columns.reach == Columns::Reach::two) {
        return between(look_up<false>(d, first, cell), look_up<false>(d, first + 1, cell));
    }
    return between(hn::GatherIndex(d, values, cell), hn::GatherIndex(d, values + 1, cell));
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
    if (slab.ahead.lines > 0) {
        // It was fetched no nearer than the second cache: the last of what the next row of pixels but one
        // lies between.
        const CellPlace next = row_place(slab, slice, std::min(j + 2, slice.pixels.y1 - 1));
        const Code* const row_behind = slice.voxels + (next.cell + 1) * slab.stride + columns.first_voxel;
        for (int n = 0; n < columns.voxels; n += cache_line / static_cast<int>(sizeof(Code))) {
            __builtin_prefetch(row_behind + n);
        }
    }
    interpolate_across<blanks>(slice.voxels + from, slab.stride, fraction, weight, columns.voxels, false,
                               row);
    if (slice.next != nullptr) {
        interpolate_across<blanks>(slice.next + from, slab.stride, fraction, weight, columns.voxels, true,
                                   row);
    }
}

// Of samples' sums over valid corners that weigh so much. Where all are valid it is the sum as it is: as it
// would be without blanks.
template <class D>
HWY_INLINE hn::Vec<D> mean_of_valid(D d, hn::Vec<D> sum, hn::Vec<D> valid) {
    // One corner weighs no less than a step along each axis.
    constexpr float nearly_all = 1 - 0.5F / (cell_steps * cell_steps);
    return hn::IfThenElse(hn::Gt(valid, hn::Set(d, nearly_all)), sum, hn::Div(sum, valid));
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

}  // namespace shearwater::shear::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
