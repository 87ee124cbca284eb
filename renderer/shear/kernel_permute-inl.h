// The kernel for 8-bit codes where tables are looked up by permuting bytes (AVX-512 with VBMI
// and VNNI). It takes a chunk of up to 32 pixels of a row on two slices at a time, and keeps what their rays
// gather in registers from slice to slice.
//
//   64 voxels each of two rows -- permuted to the pixels' places, two for each -- interpolated along -- and
//     across: codes in steps of 1 / 127 -- both slices' nearest codes as bytes, side by side -- looked up in
//     tables of 256 bytes -- both slices' values as words, side by side
//
// Extinctions become floats by a shift. Colours are summed as integers, both slices' in one instruction:
// what a sample adds to a ray's opacity, in steps of 1 / 32767, is the difference of the rounded opacities
// after and before it. So roundings never add up: the weights' sum is the rounded opacity.
#if defined(SHEARWATER_SHEAR_KERNEL_PERMUTE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SHEARWATER_SHEAR_KERNEL_PERMUTE_INL_H
#undef SHEARWATER_SHEAR_KERNEL_PERMUTE_INL_H
#else
#define SHEARWATER_SHEAR_KERNEL_PERMUTE_INL_H
#endif

#include "renderer/shear/kernel_common-inl.h"
#include "renderer/shear/kernel_permute_codes-inl.h"

#if HWY_TARGET == HWY_AVX3_DL
HWY_BEFORE_NAMESPACE();
// The target has it, though Highway does not name it to the compiler.
HWY_PUSH_ATTRIBUTES(HWY_TARGET_STR ",avx512vnni")
namespace shearwater::shear::HWY_NAMESPACE {

// What becomes of codes in cell_steps when they are to have so many bits of fraction, rounded.
template <int bits>
HWY_INLINE __m512i codes_with(__m512i codes) {
    return _mm512_mulhrs_epi16(codes, _mm512_set1_epi16((32768 << bits) / cell_steps));
}

// The less significant bytes of two slices' words, side by side.
HWY_INLINE __m512i side_by_side(__m512i words0, __m512i words1) {
    constexpr int choose = 0xca;  // bits of the second where the first has them, else of the third
    return _mm512_ternarylogic_epi32(_mm512_set1_epi16(0xff), words0, _mm512_slli_epi16(words1, 8), choose);
}

// 64 bytes looked up in a table of 256. Which of them are in its upper half: where none is, as for most
// voxels of a dim cube, that half is not looked at.
template <bool any_upper>
HWY_INLINE __m512i look_up(const OpacityTable::Bytes::Plane& plane, __m512i index, __mmask64 upper) {
    const std::uint8_t* const p = plane.data();
    const __m512i low = _mm512_permutex2var_epi8(_mm512_load_si512(p), index, _mm512_load_si512(p + 64));
    if constexpr (!any_upper) {
        return low;
    }
    const __m512i high =
        _mm512_permutex2var_epi8(_mm512_load_si512(p + 128), index, _mm512_load_si512(p + 192));
    return _mm512_mask_blend_epi8(upper, low, high);
}

// Words looked up for two slices, side by side in the dwords of pixels 0 to 15 and 16 to 31.
struct Words {
    __m512i low, high;
};
template <bool any_upper = true>
HWY_INLINE Words look_up(const OpacityTable::Bytes::Word& table, __m512i index, __mmask64 upper) {
    const __m512i high_bytes = look_up<any_upper>(table.high, index, upper);
    const __m512i low_bytes = look_up<any_upper>(table.low, index, upper);
    return {_mm512_unpacklo_epi8(low_bytes, high_bytes), _mm512_unpackhi_epi8(low_bytes, high_bytes)};
}

// The extinctions of the first or the second slice.
template <int slice>
HWY_INLINE __m512 extinctions(__m512i words) {
    const __m512i placed = slice == 0 ? _mm512_slli_epi32(words, OpacityTable::Bytes::extinction_shift)
                                      : _mm512_srli_epi32(words, 16 - OpacityTable::Bytes::extinction_shift);
    return _mm512_castsi512_ps(
        _mm512_and_si512(placed, _mm512_set1_epi32(0xffff << OpacityTable::Bytes::extinction_shift)));
}

// Of codes with so many bits of fraction, side by side.
inline constexpr int fraction_bits = 6;
template <int slice>
HWY_INLINE __m512 fractions(__m512i codes) {
    const __m512i fraction = _mm512_and_si512(slice == 0 ? codes : _mm512_srli_epi32(codes, 16),
                                              _mm512_set1_epi32((1 << fraction_bits) - 1));
    return _mm512_mul_ps(_mm512_cvtepi32_ps(fraction), _mm512_set1_ps(1.0F / (1 << fraction_bits)));
}

// What sixteen rays have gathered: the opacity, also in whole steps, and the colours since the slab began.
struct Sixteen {
    __m512 a;
    __m512i steps;  // above a constant
    __m512i r, g, b;

    static constexpr float opaque = 32767;

    static HWY_INLINE __m512i in_steps(__m512 opacity) {
        // Beyond this constant a float has no bits for fractions: adding it rounds.
        return _mm512_castps_si512(
            _mm512_fmadd_ps(opacity, _mm512_set1_ps(opaque), _mm512_set1_ps(12582912.0F)));
    }
    HWY_INLINE void begin(const float* opacity) {
        a = _mm512_loadu_ps(opacity);
        steps = in_steps(a);
        r = g = b = _mm512_setzero_si512();
    }
    // Puts a sample behind each ray, and returns what the opacities gained, in steps.
    HWY_INLINE __m512i gain(__m512 alpha) {
        a = _mm512_add_ps(a, _mm512_fnmadd_ps(a, alpha, alpha));
        const __m512i before = steps;
        steps = in_steps(a);
        return _mm512_sub_epi32(steps, before);
    }
    // What opacities gained on two slices, side by side in words.
    static HWY_INLINE __m512i side_by_side(__m512i gained0, __m512i gained1) {
        return _mm512_ternarylogic_epi32(_mm512_set1_epi32(0xffff), gained0, _mm512_slli_epi32(gained1, 16),
                                         0xca);
    }
    template <bool one_hue>
    HWY_INLINE void end(const Rays& rays, std::ptrdiff_t ray) const {
        const auto add = [](__m512i sum, float* to) HWY_ATTR {
            _mm512_storeu_ps(
                to, _mm512_fmadd_ps(_mm512_cvtepi32_ps(sum),
                                    _mm512_set1_ps(1.0F / (opaque * OpacityTable::Bytes::full_colour)),
                                    _mm512_loadu_ps(to)));
        };
        add(r, rays.r + ray);
        if constexpr (!one_hue) {
            add(g, rays.g + ray);
            add(b, rays.b + ray);
        }
        _mm512_storeu_ps(rays.a + ray, a);
    }
};

// What a row of a chunk needs on its way through the slices, two by two. Each of the three steps below runs
// over all pairs before the next begins, so that the processor has independent work at hand.
struct Row32 {
    static constexpr std::size_t max_pairs = Slab<std::uint8_t>::max_slices / 2;

    struct Pair {
        __m512i codes0, codes1;            // of the nearer and of the other slice
        const float *lengths0, *lengths1;  // their rays'
        std::uint32_t wanted0, wanted1;    // of them
        __m512 low0, low1, high0, high1;   // opacities
        __m512i nearest;                   // nodes
    };
    std::array<Pair, max_pairs> pairs;
};

// Extinctions times lengths, and what they make opaque.
template <bool between_nodes>
HWY_INLINE void classify_pair(const OpacityTable::Bytes& tables, bool faint, Row32::Pair& pair) {
    __m512i codes0 = pair.codes0, codes1 = pair.codes1;
    pair.nearest = side_by_side(codes_with<0>(codes0), codes_with<0>(codes1));
    __m512 low0, low1, high0, high1;
    if constexpr (between_nodes) {
        codes0 = codes_with<fraction_bits>(codes0);
        codes1 = codes_with<fraction_bits>(codes1);
        const __m512i below =
            side_by_side(_mm512_srli_epi16(codes0, fraction_bits), _mm512_srli_epi16(codes1, fraction_bits));
        const __m512i above = _mm512_add_epi8(below, _mm512_set1_epi8(1));
        const Words from = look_up(tables.extinction, below, _mm512_movepi8_mask(below));
        const Words to = look_up(tables.extinction, above, _mm512_movepi8_mask(above));
        const __m512i low_codes = _mm512_unpacklo_epi16(codes0, codes1);
        const __m512i high_codes = _mm512_unpackhi_epi16(codes0, codes1);
        const auto mix = [](__m512 fraction, __m512 a, __m512 b)
                             HWY_ATTR { return _mm512_fmadd_ps(fraction, _mm512_sub_ps(b, a), a); };
        low0 = mix(fractions<0>(low_codes), extinctions<0>(from.low), extinctions<0>(to.low));
        low1 = mix(fractions<1>(low_codes), extinctions<1>(from.low), extinctions<1>(to.low));
        high0 = mix(fractions<0>(high_codes), extinctions<0>(from.high), extinctions<0>(to.high));
        high1 = mix(fractions<1>(high_codes), extinctions<1>(from.high), extinctions<1>(to.high));
    } else {
        const Words at = look_up(tables.extinction, pair.nearest, _mm512_movepi8_mask(pair.nearest));
        low0 = extinctions<0>(at.low);
        low1 = extinctions<1>(at.low);
        high0 = extinctions<0>(at.high);
        high1 = extinctions<1>(at.high);
    }
    const auto times = [](__m512 extinction, const float* lengths, std::uint32_t wanted) HWY_ATTR {
        return _mm512_maskz_mul_ps(static_cast<__mmask16>(wanted), extinction, _mm512_loadu_ps(lengths));
    };
    low0 = times(low0, pair.lengths0, pair.wanted0);
    low1 = times(low1, pair.lengths1, pair.wanted1);
    high0 = times(high0, pair.lengths0 + 16, pair.wanted0 >> 16);
    high1 = times(high1, pair.lengths1 + 16, pair.wanted1 >> 16);
    const hn::Full512<float> d;
    const auto opacities = [&](__m512 depth, bool few) HWY_ATTR {
        const hn::Vec512<float> y{depth};
        return (few ? opacity_of_few_halvings(d, y) : opacity_of_halvings(d, y)).raw;
    };
    const auto all_faint = [&] HWY_ATTR {
        const __m512 deepest = _mm512_max_ps(_mm512_max_ps(low0, low1), _mm512_max_ps(high0, high1));
        return _mm512_cmp_ps_mask(deepest, _mm512_set1_ps(few_halvings), _CMP_GE_OQ) == 0;
    };
    if (HWY_LIKELY(faint || all_faint())) {
        pair.low0 = opacities(low0, true);
        pair.low1 = opacities(low1, true);
        pair.high0 = opacities(high0, true);
        pair.high1 = opacities(high1, true);
    } else {
        pair.low0 = opacities(low0, false);
        pair.low1 = opacities(low1, false);
        pair.high0 = opacities(high0, false);
        pair.high1 = opacities(high1, false);
    }
}

template <bool one_hue, bool any_upper>
HWY_INLINE void composite_pair(const OpacityTable::Bytes& tables, const Row32::Pair& pair, __mmask64 upper,
                               Sixteen& low, Sixteen& high) {
    const __m512i low0 = low.gain(pair.low0);
    const __m512i low_gained = Sixteen::side_by_side(low0, low.gain(pair.low1));
    const __m512i high0 = high.gain(pair.high0);
    const __m512i high_gained = Sixteen::side_by_side(high0, high.gain(pair.high1));
    const Words r = look_up<any_upper>(tables.r, pair.nearest, upper);
    low.r = _mm512_dpwssd_epi32(low.r, low_gained, r.low);
    high.r = _mm512_dpwssd_epi32(high.r, high_gained, r.high);
    if constexpr (!one_hue) {
        const Words g = look_up<any_upper>(tables.g, pair.nearest, upper);
        low.g = _mm512_dpwssd_epi32(low.g, low_gained, g.low);
        high.g = _mm512_dpwssd_epi32(high.g, high_gained, g.high);
        const Words b = look_up<any_upper>(tables.b, pair.nearest, upper);
        low.b = _mm512_dpwssd_epi32(low.b, low_gained, b.low);
        high.b = _mm512_dpwssd_epi32(high.b, high_gained, b.high);
    }
}

// The codes, in cell_steps, beyond which none has opacity.
struct OpaqueCodes {
    __m512i above, below;
    bool all;  // have some

    explicit OpaqueCodes(const OpacityTable& table)
        : above(_mm512_set1_epi16(static_cast<short>(std::max(table.first_opaque() - 1, -1) * cell_steps))),
          below(_mm512_set1_epi16(static_cast<short>(std::min(table.last_opaque() + 1, 256) * cell_steps))),
          all(table.first_opaque() <= 1 && table.last_opaque() >= 255) {}
    HWY_INLINE bool none(__m512i codes) const {
        return !all && (_mm512_cmpgt_epi16_mask(codes, above) & _mm512_cmplt_epi16_mask(codes, below)) == 0;
    }
};

// What does not change from row to row of a chunk.
struct Prepared {
    explicit Prepared(const OpacityTable& table) : opaque(table) {}

    OpaqueCodes opaque;
    std::array<Permutation, Slab<std::uint8_t>::max_slices> permutations;
    std::array<RowPlaces, Slab<std::uint8_t>::max_slices> rows;
};

// One row of a chunk on all slices.
template <bool blanks, bool between_nodes, bool one_hue, bool narrow>
HWY_INLINE std::uint64_t composite_row_of_chunk(const Slab<std::uint8_t>& slab, const Prepared& prepared,
                                                const OpacityTable& table, const Rays& rays, int i, int j) {
    const std::ptrdiff_t ray = j * rays.stride + i;
    Sixteen low, high;
    low.begin(rays.a + ray);
    high.begin(rays.a + ray + 16);
    const __m512 done = _mm512_set1_ps(rays.done);
    const std::uint32_t live = _mm512_cmp_ps_mask(low.a, done, _CMP_LT_OQ) |
                               static_cast<std::uint32_t>(_mm512_cmp_ps_mask(high.a, done, _CMP_LT_OQ)) << 16;
    if (live == 0) {
        return 0;
    }
    Row32 row;
    std::uint64_t taken = 0;
    std::size_t count = 0;  // of slices on which some of the row's samples may have opacity
    for (std::size_t k = 0; k < static_cast<std::size_t>(slab.count); ++k) {
        const Slice<std::uint8_t>& slice = slab.slices[k];
        const std::uint32_t wanted = prepared.permutations[k].wanted & live;
        if (j < slice.pixels.y0 || j >= slice.pixels.y1 || wanted == 0) {
            continue;
        }
        taken += static_cast<std::uint64_t>(std::popcount(wanted));
        const auto [codes, valid] =
            codes_along<narrow, blanks>(slab, slice, j, prepared.rows[k], prepared.permutations[k]);
        if (prepared.opaque.none(codes)) {
            continue;
        }
        Row32::Pair& pair = row.pairs[count / 2];
        (count % 2 == 0 ? pair.codes0 : pair.codes1) = codes;
        (count % 2 == 0 ? pair.lengths0 : pair.lengths1) = slice.lengths + ray;
        (count % 2 == 0 ? pair.wanted0 : pair.wanted1) = wanted & valid;
        ++count;
    }
    if (count == 0) {
        return taken;
    }
    if (count % 2 == 1) {
        Row32::Pair& pair = row.pairs[count / 2];
        pair.codes1 = pair.codes0;
        pair.lengths1 = pair.lengths0;
        pair.wanted1 = 0;
    }
    const std::size_t pairs = (count + 1) / 2;
    for (std::size_t p = 0; p < pairs; ++p) {
        classify_pair<between_nodes>(table.bytes(), slab.faint, row.pairs[p]);
    }
    for (std::size_t p = 0; p < pairs; ++p) {
        const Row32::Pair& pair = row.pairs[p];
        const __mmask64 upper = _mm512_movepi8_mask(pair.nearest);
        // One channel's table is looked up as soon.
        if (one_hue || upper != 0) {
            composite_pair<one_hue, true>(table.bytes(), pair, upper, low, high);
        } else {
            composite_pair<one_hue, false>(table.bytes(), pair, upper, low, high);
        }
    }
    low.end<one_hue>(rays, ray);
    high.end<one_hue>(rays, ray + 16);
    return taken;
}

template <bool blanks, bool between_nodes, bool one_hue>
std::uint64_t composite_permuting_as(const Slab<std::uint8_t>& slab, const OpacityTable& table,
                                     const Rays& rays) {
    const view::Rect pixels = pixels_of(slab);
    double scale = 0;
    for (int k = 0; k < slab.count; ++k) {
        scale = std::max(scale, std::abs(slab.slices[static_cast<std::size_t>(k)].fast_scale));
    }
    // So many pixels lie within 64 voxels.
    const double room = (permuted_voxels - 2) / scale;
    const int most = room >= permuted_pixels ? permuted_pixels : std::max(1, static_cast<int>(room));
    std::uint64_t taken = 0;
    Fetching fetching(slab.ahead, (pixels.width() + most - 1) / most * pixels.height());
    Prepared prepared(table);
    for (std::size_t k = 0; k < static_cast<std::size_t>(slab.count); ++k) {
        lay_rows(slab, slab.slices[k], prepared.rows[k]);
    }
    // Wide spans are cut where vectors of rays begin.
    const bool wide = most == permuted_pixels && pixels.width() > permuted_pixels;
    for (int i = wide ? pixels.x0 / permuted_pixels * permuted_pixels : pixels.x0; i < pixels.x1; i += most) {
        for (std::size_t k = 0; k < static_cast<std::size_t>(slab.count); ++k) {
            prepared.permutations[k] = permutation_of(slab, slab.slices[k], i, most);
        }
        const bool narrow = (std::min(pixels.x1, i + most) - std::max(pixels.x0, i)) * scale <= narrow_voxels;
        for (int j = pixels.y0; j < pixels.y1; ++j) {
            fetching.step<Into::second>();
            taken += narrow ? composite_row_of_chunk<blanks, between_nodes, one_hue, true>(slab, prepared,
                                                                                           table, rays, i, j)
                            : composite_row_of_chunk<blanks, between_nodes, one_hue, false>(
                                  slab, prepared, table, rays, i, j);
        }
    }
    return taken;
}

template <bool blanks>
std::uint64_t composite_permuting(const Slab<std::uint8_t>& slab, const OpacityTable& table,
                                  const Rays& rays) {
    if (table.one_hue()) {
        return slab.between_nodes ? composite_permuting_as<blanks, true, true>(slab, table, rays)
                                  : composite_permuting_as<blanks, false, true>(slab, table, rays);
    }
    return slab.between_nodes ? composite_permuting_as<blanks, true, false>(slab, table, rays)
                              : composite_permuting_as<blanks, false, false>(slab, table, rays);
}

}  // namespace shearwater::shear::HWY_NAMESPACE
HWY_POP_ATTRIBUTES
HWY_AFTER_NAMESPACE();

#endif
#endif
