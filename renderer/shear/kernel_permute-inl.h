// The kernel for 8-bit codes without blanks where tables are looked up by permuting bytes (AVX-512 with VBMI
// and VNNI). It takes a chunk of up to 32 pixels of a row on two slices at a time, and keeps what their rays
// gather in registers from slice to slice.
//
//   64 voxels each of two rows -- interpolated across -- permuted to the pixels' places -- interpolated
//     along: codes in steps of 1 / 127 -- both slices' nearest codes as bytes, side by side -- looked up in
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

#if HWY_TARGET == HWY_AVX3_DL
HWY_BEFORE_NAMESPACE();
// The target has it, though Highway does not name it to the compiler.
HWY_PUSH_ATTRIBUTES(HWY_TARGET_STR ",avx512vnni")
namespace shearwater::shear::HWY_NAMESPACE {

inline constexpr int permuted_pixels = 32;
inline constexpr int permuted_voxels = 64;
static_assert(cell_steps == 127, "both weights are signed bytes, and codes times it signed words");

// Where eight pixels lie, in cell_steps from a voxel: what place_of gives, undivided.
HWY_INLINE __m512i steps_of_eight(double offset, double scale, int pixel, std::int64_t first_voxel) {
    const __m512d pixels = _mm512_add_pd(_mm512_set1_pd(pixel), _mm512_setr_pd(0, 1, 2, 3, 4, 5, 6, 7));
    const __m512d at = _mm512_add_pd(_mm512_mul_pd(pixels, _mm512_set1_pd(scale)), _mm512_set1_pd(offset));
    return _mm512_sub_epi64(_mm512_cvttpd_epi64(_mm512_add_pd(_mm512_mul_pd(at, _mm512_set1_pd(cell_steps)),
                                                              _mm512_set1_pd(0.5))),
                            _mm512_set1_epi64(first_voxel * cell_steps));
}

// For the pixels of a chunk: which are wanted on a slice, and which voxels of the 64 from `first` on each
// lies between.
struct Permutation {
    __m512i left, right;  // indices into a row interpolated across
    __m512i fraction;     // 15 bits
    std::ptrdiff_t first;
    std::uint32_t wanted;
};

// Words of two vectors of dwords, pixels 0 to 15 and 16 to 31, such that interleaving the bytes of two such
// vectors, and again those of what is looked up by them, gives pixels in order: in each 16 bytes four
// pixels of the first half, then four of the second.
HWY_INLINE __m512i words_of_pixels(__m512i low, __m512i high, int word) {
    alignas(64) static constexpr std::uint16_t pixels[permuted_pixels] = {
        0, 1, 2,  3,  16, 17, 18, 19, 4,  5,  6,  7,  20, 21, 22, 23,
        8, 9, 10, 11, 24, 25, 26, 27, 12, 13, 14, 15, 28, 29, 30, 31};
    const __m512i index = _mm512_add_epi16(_mm512_slli_epi16(_mm512_load_si512(pixels), 1),
                                           _mm512_set1_epi16(static_cast<short>(word)));
    return _mm512_permutex2var_epi16(low, index, high);
}

HWY_INLINE Permutation permutation_of(const Slab<std::uint8_t>& slab, const Slice<std::uint8_t>& slice, int i,
                                      int width) {
    const int begin = std::max(slice.pixels.x0, i) - i;
    const int count = std::min(slice.pixels.x1, i + width) - i - begin;
    Permutation permutation;
    permutation.wanted = 0;
    if (count <= 0) {
        return permutation;
    }
    const double from = along_row(slice, slab.fast_pixel + i + begin);
    const double to = along_row(slice, slab.fast_pixel + i + begin + count - 1);
    const auto first = std::clamp(static_cast<std::int64_t>(std::min(from, to)), slab.fast_first,
                                  slab.fast_first + slab.fast_cells - 1);
    // Pixels that are not wanted take some voxel or other.
    const __m512i most = _mm512_set1_epi32((permuted_voxels - 2) * cell_steps);
    const auto quarter = [&](int lane) HWY_ATTR {
        return _mm512_cvtsepi64_epi32(
            steps_of_eight(slice.fast_offset, slice.fast_scale, slab.fast_pixel + i + lane, first));
    };
    const auto half = [&](int lane) HWY_ATTR {
        const __m512i steps = _mm512_inserti64x4(_mm512_castsi256_si512(quarter(lane)), quarter(lane + 8), 1);
        const __m512i in_window = _mm512_min_epi32(_mm512_max_epi32(steps, _mm512_setzero_si512()), most);
        // Divided by cell_steps: exact for what is this small.
        const __m512i cell = _mm512_srli_epi32(_mm512_mullo_epi32(in_window, _mm512_set1_epi32(33027)), 22);
        const __m512i step =
            _mm512_sub_epi32(in_window, _mm512_mullo_epi32(cell, _mm512_set1_epi32(cell_steps)));
        const __m512 fraction =
            _mm512_mul_ps(_mm512_cvtepi32_ps(step), _mm512_set1_ps(32767.0F / cell_steps));
        return _mm512_or_si512(_mm512_slli_epi32(cell, 16), _mm512_cvtps_epi32(fraction));
    };
    const __m512i low = half(0);
    const __m512i high = half(16);
    const __m512i cell = words_of_pixels(low, high, 1);
    // Interleaving two rows of voxels within 16 bytes leaves each eight in one of two vectors by turns.
    const auto index = [](__m512i voxel) HWY_ATTR {
        const __m512i in_eight = _mm512_and_si512(voxel, _mm512_set1_epi16(7));
        const __m512i lane =
            _mm512_slli_epi16(_mm512_and_si512(_mm512_srli_epi16(voxel, 4), _mm512_set1_epi16(3)), 3);
        const __m512i vector = _mm512_slli_epi16(_mm512_and_si512(voxel, _mm512_set1_epi16(8)), 2);
        return _mm512_or_si512(in_eight, _mm512_or_si512(lane, vector));
    };
    permutation.left = index(cell);
    permutation.right = index(_mm512_add_epi16(cell, _mm512_set1_epi16(1)));
    permutation.fraction = words_of_pixels(low, high, 0);
    permutation.first = first - slab.fast_first;
    permutation.wanted = 0xffffffffU >> (permuted_pixels - count) << begin;
    return permutation;
}

// For the rows of a slab: where they lie among a slice's rows of voxels.
struct RowPlaces {
    std::array<std::int64_t, tallest_tile + 8> offsets;   // of the row before, from the slice's first voxel
    std::array<std::uint16_t, tallest_tile + 8> weights;  // of it and of the row behind, a byte each
};

HWY_INLINE void lay_rows(const Slab<std::uint8_t>& slab, const Slice<std::uint8_t>& slice,
                         RowPlaces& places) {
    for (int j = slice.pixels.y0; j < slice.pixels.y1; j += 8) {
        const __m512i steps =
            steps_of_eight(slice.slow_offset, slice.slow_scale, slab.slow_pixel + j, slab.slow_first);
        // Divided by cell_steps, by way of a product that is exact for all that a double may hold of it.
        // A row on the last row of voxels belongs to the last cell.
        const __m512i cell = _mm512_min_epi64(
            _mm512_cvttpd_epi64(_mm512_mul_pd(_mm512_add_pd(_mm512_cvtepi64_pd(steps), _mm512_set1_pd(0.5)),
                                              _mm512_set1_pd(1.0 / cell_steps))),
            _mm512_set1_epi64(slab.slow_cells - 1));
        const __m512i step = _mm512_sub_epi64(steps, _mm512_mullo_epi64(cell, _mm512_set1_epi64(cell_steps)));
        const __m512i weights = _mm512_or_si512(_mm512_sub_epi64(_mm512_set1_epi64(cell_steps), step),
                                                _mm512_slli_epi64(step, 8));
        const auto n = static_cast<std::size_t>(j);
        _mm512_storeu_si512(&places.offsets[n], _mm512_mullo_epi64(cell, _mm512_set1_epi64(slab.stride)));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(&places.weights[n]), _mm512_cvtepi64_epi16(weights));
    }
}

// Codes in cell_steps at the pixels of one row.
HWY_INLINE __m512i codes_along(const Slab<std::uint8_t>& slab, const Slice<std::uint8_t>& slice, int j,
                               const RowPlaces& places, const Permutation& permutation) {
    const auto row = static_cast<std::size_t>(j);
    const __m512i weights = _mm512_set1_epi16(static_cast<short>(places.weights[row]));
    const std::ptrdiff_t from = places.offsets[row] + permutation.first;
    const std::ptrdiff_t stride = slab.stride;
    __m512i low, high;
    _mm_prefetch(slice.voxels + from + slab.ahead, _MM_HINT_T0);
    _mm_prefetch(slice.voxels + from + slab.ahead + stride + 48, _MM_HINT_T0);
    const auto across = [&](const std::uint8_t* voxels) HWY_ATTR {
        const __m512i row0 = _mm512_loadu_si512(voxels + from);
        const __m512i row1 = _mm512_loadu_si512(voxels + from + stride);
        low = _mm512_maddubs_epi16(_mm512_unpacklo_epi8(row0, row1), weights);
        high = _mm512_maddubs_epi16(_mm512_unpackhi_epi8(row0, row1), weights);
    };
    across(slice.voxels);
    if (slice.next != nullptr) {
        const __m512i low0 = low, high0 = high;
        across(slice.next);
        low = _mm512_avg_epu16(low, low0);
        high = _mm512_avg_epu16(high, high0);
    }
    const __m512i left = _mm512_permutex2var_epi16(low, permutation.left, high);
    const __m512i right = _mm512_permutex2var_epi16(low, permutation.right, high);
    return _mm512_add_epi16(left, _mm512_mulhrs_epi16(_mm512_sub_epi16(right, left), permutation.fraction));
}

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

// 64 bytes looked up in a table of 256.
HWY_INLINE __m512i look_up(const OpacityTable::Bytes::Plane& plane, __m512i index, __mmask64 upper) {
    const std::uint8_t* const p = plane.data();
    const __m512i low = _mm512_permutex2var_epi8(_mm512_load_si512(p), index, _mm512_load_si512(p + 64));
    const __m512i high =
        _mm512_permutex2var_epi8(_mm512_load_si512(p + 128), index, _mm512_load_si512(p + 192));
    return _mm512_mask_blend_epi8(upper, low, high);
}

// Words looked up for two slices, side by side in the dwords of pixels 0 to 15 and 16 to 31.
struct Words {
    __m512i low, high;
};
HWY_INLINE Words look_up(const OpacityTable::Bytes::Word& table, __m512i index, __mmask64 upper) {
    const __m512i high_bytes = look_up(table.high, index, upper);
    const __m512i low_bytes = look_up(table.low, index, upper);
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
    HWY_INLINE void add_colours(__m512i gained0, __m512i gained1, __m512i red, __m512i green, __m512i blue) {
        const __m512i gained = _mm512_ternarylogic_epi32(_mm512_set1_epi32(0xffff), gained0,
                                                         _mm512_slli_epi32(gained1, 16), 0xca);
        r = _mm512_dpwssd_epi32(r, gained, red);
        g = _mm512_dpwssd_epi32(g, gained, green);
        b = _mm512_dpwssd_epi32(b, gained, blue);
    }
    HWY_INLINE void end(const Rays& rays, std::ptrdiff_t ray) const {
        const auto add = [](__m512i sum, float* to) HWY_ATTR {
            _mm512_storeu_ps(
                to, _mm512_fmadd_ps(_mm512_cvtepi32_ps(sum),
                                    _mm512_set1_ps(1.0F / (opaque * OpacityTable::Bytes::full_colour)),
                                    _mm512_loadu_ps(to)));
        };
        add(r, rays.r + ray);
        add(g, rays.g + ray);
        add(b, rays.b + ray);
        _mm512_storeu_ps(rays.a + ray, a);
    }
};

// What a row of a chunk needs on its way through the slices, two by two. Each of the three steps below runs
// over all pairs before the next begins, so that the processor has independent work at hand.
struct Row32 {
    static constexpr std::size_t max_pairs = Slab<std::uint8_t>::max_slices / 2;

    struct Pair {
        __m512i codes0, codes1;           // of the nearer and of the other slice
        __m512 low0, low1, high0, high1;  // lengths, then opacities
        __m512i nearest;                  // nodes
        bool any;                         // of them has opacity
    };
    std::array<Pair, max_pairs> pairs;
};

// Extinctions times lengths, and what they make opaque.
template <bool between_nodes>
HWY_INLINE void classify_pair(const OpacityTable::Bytes& tables, Row32::Pair& pair) {
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
    low0 = _mm512_mul_ps(low0, pair.low0);
    low1 = _mm512_mul_ps(low1, pair.low1);
    high0 = _mm512_mul_ps(high0, pair.high0);
    high1 = _mm512_mul_ps(high1, pair.high1);
    const __m512 deepest = _mm512_max_ps(_mm512_max_ps(low0, low1), _mm512_max_ps(high0, high1));
    pair.any = _mm512_cmp_ps_mask(deepest, _mm512_setzero_ps(), _CMP_GT_OQ) != 0;
    const hn::Full512<float> d;
    const auto opacities = [&](__m512 depth, bool shallow) HWY_ATTR {
        const hn::Vec512<float> y{depth};
        return (shallow ? opacity_of_few_halvings(d, y) : opacity_of_halvings(d, y)).raw;
    };
    const bool shallow = _mm512_cmp_ps_mask(deepest, _mm512_set1_ps(few_halvings), _CMP_GE_OQ) == 0;
    if (HWY_LIKELY(shallow)) {
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

HWY_INLINE void composite_pair(const OpacityTable::Bytes& tables, const Row32::Pair& pair, Sixteen& low,
                               Sixteen& high) {
    const __mmask64 upper = _mm512_movepi8_mask(pair.nearest);
    const Words r = look_up(tables.r, pair.nearest, upper);
    const Words g = look_up(tables.g, pair.nearest, upper);
    const Words b = look_up(tables.b, pair.nearest, upper);
    const __m512i low_gain0 = low.gain(pair.low0);
    const __m512i low_gain1 = low.gain(pair.low1);
    low.add_colours(low_gain0, low_gain1, r.low, g.low, b.low);
    const __m512i high_gain0 = high.gain(pair.high0);
    const __m512i high_gain1 = high.gain(pair.high1);
    high.add_colours(high_gain0, high_gain1, r.high, g.high, b.high);
}

// What does not change from row to row of a chunk.
struct Prepared {
    std::array<Permutation, Slab<std::uint8_t>::max_slices> permutations;
    std::array<RowPlaces, Slab<std::uint8_t>::max_slices> rows;
};

// One row of a chunk on all slices.
template <bool between_nodes>
HWY_INLINE std::uint64_t composite_row_of_chunk(const Slab<std::uint8_t>& slab, const Prepared& prepared,
                                                const OpacityTable& table, const Rays& rays, int i, int j) {
    const std::ptrdiff_t ray = j * rays.stride + i;
    Sixteen low, high;
    low.begin(rays.a + ray);
    high.begin(rays.a + ray + 16);
    const __m512 done = _mm512_set1_ps(opaque_enough);
    const std::uint32_t live = _mm512_cmp_ps_mask(low.a, done, _CMP_LT_OQ) |
                               static_cast<std::uint32_t>(_mm512_cmp_ps_mask(high.a, done, _CMP_LT_OQ)) << 16;
    if (live == 0) {
        return 0;
    }
    Row32 row;
    std::uint64_t taken = 0;
    std::size_t count = 0;  // of slices that want some of the row's pixels
    for (std::size_t k = 0; k < static_cast<std::size_t>(slab.count); ++k) {
        const Slice<std::uint8_t>& slice = slab.slices[k];
        const std::uint32_t wanted = prepared.permutations[k].wanted & live;
        if (j < slice.pixels.y0 || j >= slice.pixels.y1 || wanted == 0) {
            continue;
        }
        taken += static_cast<std::uint64_t>(std::popcount(wanted));
        Row32::Pair& pair = row.pairs[count / 2];
        (count % 2 == 0 ? pair.codes0 : pair.codes1) =
            codes_along(slab, slice, j, prepared.rows[k], prepared.permutations[k]);
        (count % 2 == 0 ? pair.low0 : pair.low1) =
            _mm512_maskz_loadu_ps(static_cast<__mmask16>(wanted), slice.lengths + ray);
        (count % 2 == 0 ? pair.high0 : pair.high1) =
            _mm512_maskz_loadu_ps(static_cast<__mmask16>(wanted >> 16), slice.lengths + ray + 16);
        ++count;
    }
    if (count == 0) {
        return 0;
    }
    if (count % 2 == 1) {
        Row32::Pair& pair = row.pairs[count / 2];
        pair.codes1 = pair.codes0;
        pair.low1 = pair.high1 = _mm512_setzero_ps();
    }
    const std::size_t pairs = (count + 1) / 2;
    bool any = false;
    for (std::size_t p = 0; p < pairs; ++p) {
        classify_pair<between_nodes>(table.bytes(), row.pairs[p]);
        any = any || row.pairs[p].any;
    }
    if (!any) {
        return taken;
    }
    for (std::size_t p = 0; p < pairs; ++p) {
        if (row.pairs[p].any) {
            composite_pair(table.bytes(), row.pairs[p], low, high);
        }
    }
    low.end(rays, ray);
    high.end(rays, ray + 16);
    return taken;
}

template <bool between_nodes>
std::uint64_t composite_permuting(const Slab<std::uint8_t>& slab, const OpacityTable& table,
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
    Prepared prepared;
    for (std::size_t k = 0; k < static_cast<std::size_t>(slab.count); ++k) {
        lay_rows(slab, slab.slices[k], prepared.rows[k]);
    }
    // Wide spans are cut where vectors of rays begin.
    const bool wide = most == permuted_pixels && pixels.width() > permuted_pixels;
    for (int i = wide ? pixels.x0 / permuted_pixels * permuted_pixels : pixels.x0; i < pixels.x1; i += most) {
        for (std::size_t k = 0; k < static_cast<std::size_t>(slab.count); ++k) {
            prepared.permutations[k] = permutation_of(slab, slab.slices[k], i, most);
        }
        for (int j = pixels.y0; j < pixels.y1; ++j) {
            taken += composite_row_of_chunk<between_nodes>(slab, prepared, table, rays, i, j);
        }
    }
    return taken;
}

}  // namespace shearwater::shear::HWY_NAMESPACE
HWY_POP_ATTRIBUTES
HWY_AFTER_NAMESPACE();

#endif
#endif
