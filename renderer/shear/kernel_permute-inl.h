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
    const auto least = static_cast<double>(slab.fast_first);
    const double first = std::clamp(std::floor(std::min(from, to)), least, least + slab.fast_cells - 1);
    // Pixels that are not wanted take some voxel or other.
    const __m512i most = _mm512_set1_epi32((permuted_voxels - 2) * cell_steps);
    const __m512i first_steps = _mm512_set1_epi32(static_cast<int>(first) * cell_steps);
    const auto quarter = [&](int lane) HWY_ATTR {
        const __m512d pixels =
            _mm512_add_pd(_mm512_set1_pd(slab.fast_pixel + i + lane), _mm512_setr_pd(0, 1, 2, 3, 4, 5, 6, 7));
        const __m512d at = _mm512_add_pd(_mm512_mul_pd(pixels, _mm512_set1_pd(slice.fast_scale)),
                                         _mm512_set1_pd(slice.fast_offset));
        return _mm512_cvttpd_epi32(
            _mm512_add_pd(_mm512_mul_pd(at, _mm512_set1_pd(cell_steps)), _mm512_set1_pd(0.5)));
    };
    const auto half = [&](int lane) HWY_ATTR {
        const __m512i steps = _mm512_inserti64x4(_mm512_castsi256_si512(quarter(lane)), quarter(lane + 8), 1);
        const __m512i in_window = _mm512_min_epi32(
            _mm512_max_epi32(_mm512_sub_epi32(steps, first_steps), _mm512_setzero_si512()), most);
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
    permutation.first = static_cast<std::ptrdiff_t>(first - least);
    permutation.wanted = 0xffffffffU >> (permuted_pixels - count) << begin;
    return permutation;
}

// Codes in cell_steps at the pixels of one row.
HWY_INLINE __m512i codes_along(const Slab<std::uint8_t>& slab, const Slice<std::uint8_t>& slice, int j,
                               const Permutation& permutation) {
    const CellPlace place = row_place(slab, slice, j);
    const std::ptrdiff_t stride = slab.stride;
    const __m512i weights = _mm512_set1_epi16(static_cast<short>(cell_steps - place.step + 256 * place.step));
    const std::ptrdiff_t from = place.cell * stride + permutation.first;
    __m512i low, high;
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

HWY_INLINE __m512 opacities(__m512 depth) {
    return opacity_of_halvings(hn::Full512<float>(), hn::Vec512<float>{depth}).raw;
}

// The rays of a chunk, and the lengths of a slice on them.
struct Chunk {
    Sixteen low, high;
};
struct Lengths {
    __m512 low, high;

    Lengths(const float* lengths, std::uint32_t wanted)
        : low(_mm512_maskz_loadu_ps(static_cast<__mmask16>(wanted), lengths)),
          high(_mm512_maskz_loadu_ps(static_cast<__mmask16>(wanted >> 16), lengths + 16)) {}
};

// The samples of a chunk on two slices, the nearer first. Rays that want none have no length.
template <bool between_nodes>
HWY_INLINE void composite_pair(__m512i codes0, __m512i codes1, const OpacityTable::Bytes& tables,
                               const Lengths& lengths0, const Lengths& lengths1, Chunk& chunk) {
    const __m512i nearest = side_by_side(codes_with<0>(codes0), codes_with<0>(codes1));
    const __mmask64 nearest_upper = _mm512_movepi8_mask(nearest);
    __m512 low0, low1, high0, high1;  // extinctions, then optical depths
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
        const Words at = look_up(tables.extinction, nearest, nearest_upper);
        low0 = extinctions<0>(at.low);
        low1 = extinctions<1>(at.low);
        high0 = extinctions<0>(at.high);
        high1 = extinctions<1>(at.high);
    }
    low0 = _mm512_mul_ps(low0, lengths0.low);
    low1 = _mm512_mul_ps(low1, lengths1.low);
    high0 = _mm512_mul_ps(high0, lengths0.high);
    high1 = _mm512_mul_ps(high1, lengths1.high);
    const __m512 any = _mm512_or_ps(_mm512_or_ps(low0, low1), _mm512_or_ps(high0, high1));
    if (_mm512_test_epi32_mask(_mm512_castps_si512(any), _mm512_castps_si512(any)) == 0) {
        return;
    }
    const Words r = look_up(tables.r, nearest, nearest_upper);
    const Words g = look_up(tables.g, nearest, nearest_upper);
    const Words b = look_up(tables.b, nearest, nearest_upper);
    const __m512i low_gain0 = chunk.low.gain(opacities(low0));
    const __m512i low_gain1 = chunk.low.gain(opacities(low1));
    chunk.low.add_colours(low_gain0, low_gain1, r.low, g.low, b.low);
    const __m512i high_gain0 = chunk.high.gain(opacities(high0));
    const __m512i high_gain1 = chunk.high.gain(opacities(high1));
    chunk.high.add_colours(high_gain0, high_gain1, r.high, g.high, b.high);
}

// One row of a chunk on all slices.
template <bool between_nodes>
HWY_INLINE std::uint64_t composite_row_of_chunk(const Slab<std::uint8_t>& slab,
                                                const Permutation* permutations, const OpacityTable& table,
                                                const Rays& rays, int i, int j) {
    const std::ptrdiff_t ray = j * rays.stride + i;
    Chunk chunk;
    chunk.low.begin(rays.a + ray);
    chunk.high.begin(rays.a + ray + 16);
    const __m512 done = _mm512_set1_ps(opaque_enough);
    const std::uint32_t live = _mm512_cmp_ps_mask(chunk.low.a, done, _CMP_LT_OQ) |
                               static_cast<std::uint32_t>(_mm512_cmp_ps_mask(chunk.high.a, done, _CMP_LT_OQ))
                                   << 16;
    if (live == 0) {
        return 0;
    }
    std::uint64_t taken = 0;
    const auto wanted = [&](int k) HWY_ATTR {
        const view::Rect& pixels = slab.slices[static_cast<std::size_t>(k)].pixels;
        return pixels.y0 <= j && j < pixels.y1 ? permutations[k].wanted & live : 0U;
    };
    for (int k = 0; k < slab.count; k += 2) {
        const int next = std::min(k + 1, slab.count - 1);
        const std::uint32_t wanted0 = wanted(k);
        const std::uint32_t wanted1 = next == k ? 0 : wanted(next);
        if ((wanted0 | wanted1) == 0) {
            continue;
        }
        taken += static_cast<std::uint64_t>(std::popcount(wanted0) + std::popcount(wanted1));
        // For a slice that wants none of the row's pixels the other stands in.
        const int k0 = wanted0 != 0 ? k : next;
        const int k1 = wanted1 != 0 ? next : k;
        const Slice<std::uint8_t>& slice0 = slab.slices[static_cast<std::size_t>(k0)];
        const Slice<std::uint8_t>& slice1 = slab.slices[static_cast<std::size_t>(k1)];
        composite_pair<between_nodes>(codes_along(slab, slice0, j, permutations[k0]),
                                      codes_along(slab, slice1, j, permutations[k1]), table.bytes(),
                                      Lengths(slice0.lengths + ray, wanted0),
                                      Lengths(slice1.lengths + ray, wanted1), chunk);
    }
    chunk.low.end(rays, ray);
    chunk.high.end(rays, ray + 16);
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
    std::array<Permutation, Slab<std::uint8_t>::max_slices> permutations;
    for (int i = pixels.x0; i < pixels.x1; i += most) {
        for (int k = 0; k < slab.count; ++k) {
            permutations[static_cast<std::size_t>(k)] =
                permutation_of(slab, slab.slices[static_cast<std::size_t>(k)], i, most);
        }
        for (int j = pixels.y0; j < pixels.y1; ++j) {
            taken += composite_row_of_chunk<between_nodes>(slab, permutations.data(), table, rays, i, j);
        }
    }
    return taken;
}

}  // namespace shearwater::shear::HWY_NAMESPACE
HWY_POP_ATTRIBUTES
HWY_AFTER_NAMESPACE();

#endif
#endif
