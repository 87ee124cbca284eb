// What kernel_permute-inl.h begins with: from voxels to the codes at the pixels of a chunk, interpolated.
#if defined(SHEARWATER_SHEAR_KERNEL_PERMUTE_CODES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SHEARWATER_SHEAR_KERNEL_PERMUTE_CODES_INL_H
#undef SHEARWATER_SHEAR_KERNEL_PERMUTE_CODES_INL_H
#else
#define SHEARWATER_SHEAR_KERNEL_PERMUTE_CODES_INL_H
#endif

#include "renderer/shear/kernel_common-inl.h"

#if HWY_TARGET == HWY_AVX3_DL
HWY_BEFORE_NAMESPACE();
// The target has it, though Highway does not name it to the compiler.
HWY_PUSH_ATTRIBUTES(HWY_TARGET_STR ",avx512vnni")
namespace shearwater::shear::HWY_NAMESPACE {

inline constexpr int permuted_pixels = 32;
inline constexpr int permuted_voxels = 64;
inline constexpr int narrow_voxels = 28;  // that a narrow chunk's pixels span
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
    __m512i voxels;   // the one before and the one behind each pixel, side by side
    __m512i weights;  // theirs, in cell_steps
    std::ptrdiff_t first;
    int needed;  // voxels, from that on
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
        return _mm512_or_si512(_mm512_slli_epi32(cell, 16), step);
    };
    const __m512i low = half(0);
    // Narrow chunks have no second half.
    const __m512i high = begin + count > 16 ? half(16) : _mm512_setzero_si512();
    const __m512i cell = words_of_pixels(low, high, 1);
    const __m512i step = words_of_pixels(low, high, 0);
    const auto bytes = [](__m512i before, __m512i behind)
                           HWY_ATTR { return _mm512_or_si512(before, _mm512_slli_epi16(behind, 8)); };
    permutation.voxels = bytes(cell, _mm512_add_epi16(cell, _mm512_set1_epi16(1)));
    permutation.weights = bytes(_mm512_sub_epi16(_mm512_set1_epi16(cell_steps), step), step);
    permutation.first = first - slab.fast_first;
    // Rounding to steps may lead to the next voxel, and interpolation to the one beyond.
    permutation.needed = static_cast<int>(static_cast<std::int64_t>(std::max(from, to)) - first) + 3;
    permutation.wanted = 0xffffffffU >> (permuted_pixels - count) << begin;
    return permutation;
}

// For the rows of a slab, and two more where they are fetched ahead: where they lie among a slice's rows of
// voxels.
struct RowPlaces {
    std::array<std::int64_t, tallest_tile + 16> offsets;  // of the row before, from the slice's first voxel
    std::array<std::int32_t, tallest_tile + 16> weights;  // of the row behind, 15 bits, twice
};

HWY_INLINE void lay_rows(const Slab<std::uint8_t>& slab, const Slice<std::uint8_t>& slice,
                         RowPlaces& places) {
    const int end = slab.ahead.lines > 0 ? slice.pixels.y1 + 2 : slice.pixels.y1;
    for (int j = slice.pixels.y0; j < end; j += 8) {
        const __m512i steps =
            steps_of_eight(slice.slow_offset, slice.slow_scale, slab.slow_pixel + j, slab.slow_first);
        // Divided by cell_steps, by way of a product that is exact for all that a double may hold of it.
        // A row on the last row of voxels belongs to the last cell.
        const __m512i cell = _mm512_min_epi64(
            _mm512_cvttpd_epi64(_mm512_mul_pd(_mm512_add_pd(_mm512_cvtepi64_pd(steps), _mm512_set1_pd(0.5)),
                                              _mm512_set1_pd(1.0 / cell_steps))),
            _mm512_set1_epi64(slab.slow_cells - 1));
        const __m512i step = _mm512_sub_epi64(steps, _mm512_mullo_epi64(cell, _mm512_set1_epi64(cell_steps)));
        // Rounded: step * 32767 / cell_steps, which is 258 and a little more.
        const __m256i weights = _mm512_cvtepi64_epi32(
            _mm512_add_epi64(_mm512_mullo_epi64(step, _mm512_set1_epi64(258)), _mm512_srli_epi64(step, 6)));
        const auto n = static_cast<std::size_t>(j);
        _mm512_storeu_si512(&places.offsets[n], _mm512_mullo_epi64(cell, _mm512_set1_epi64(slab.stride)));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(&places.weights[n]),
                            _mm256_or_si256(weights, _mm256_slli_epi32(weights, 16)));
    }
}

// Voxels of a row from one on: all permuted_voxels, or of a narrow chunk no more than it needs, for lines of
// memory that no sample lies on would have to be waited for.
template <bool narrow>
HWY_INLINE __m512i voxels_at(const std::uint8_t* first, int needed) {
    if constexpr (narrow) {
        if (needed <= 16) {
            return _mm512_castsi128_si512(_mm_loadu_si128(reinterpret_cast<const __m128i*>(first)));
        }
        if (needed <= 32) {
            return _mm512_castsi256_si512(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(first)));
        }
    }
    return _mm512_loadu_si512(first);
}

// Between two rows' words, by the weight of the row behind.
HWY_INLINE __m512i between_rows(__m512i before, __m512i behind, __m512i weight) {
    return _mm512_add_epi16(before, _mm512_mulhrs_epi16(_mm512_sub_epi16(behind, before), weight));
}

// Of the words that interleaving puts in order, as pixels_of_words has them.
HWY_INLINE std::uint32_t in_order(std::uint32_t of_words) {
    return _pext_u32(of_words, 0x0f0f0f0fU) | _pext_u32(of_words, 0xf0f0f0f0U) << 16;
}

// The codes of one row of pixels, in cell_steps, and which pixels have one.
struct RowCodes {
    __m512i codes;
    std::uint32_t valid;
};

// The mean of the valid corners' codes; what of all corners is valid is 255 in cell_steps where all are.
HWY_INLINE RowCodes mean_of_valid(__m512i codes, __m512i valid) {
    constexpr int whole = 255 * cell_steps;
    if (HWY_LIKELY(_mm512_cmpneq_epi16_mask(valid, _mm512_set1_epi16(whole)) == 0)) {
        return {codes, ~0U};
    }
    const auto mean = [](__m256i of_codes, __m256i of_valid) HWY_ATTR {
        const __m512 sum = _mm512_cvtepi32_ps(_mm512_cvtepu16_epi32(of_codes));
        const __m512 weight = _mm512_cvtepi32_ps(_mm512_cvtepu16_epi32(of_valid));
        // What weighs nothing is left out below.
        const __m512 scale = _mm512_div_ps(_mm512_set1_ps(whole), _mm512_max_ps(weight, _mm512_set1_ps(1)));
        return _mm512_cvtusepi32_epi16(
            _mm512_cvtps_epi32(_mm512_min_ps(_mm512_mul_ps(sum, scale), _mm512_set1_ps(whole))));
    };
    const __m256i low = mean(_mm512_castsi512_si256(codes), _mm512_castsi512_si256(valid));
    const __m256i high = mean(_mm512_extracti64x4_epi64(codes, 1), _mm512_extracti64x4_epi64(valid, 1));
    const std::uint32_t enough =
        _mm512_cmpge_epi16_mask(valid, _mm512_set1_epi16(static_cast<short>(whole * least_valid)));
    return {_mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1), in_order(enough)};
}

// Codes at the pixels of one row.
template <bool narrow, bool blanks>
HWY_INLINE RowCodes codes_along(const Slab<std::uint8_t>& slab, const Slice<std::uint8_t>& slice, int j,
                                const RowPlaces& places, const Permutation& permutation) {
    struct Words {
        __m512i codes, valid;
    };
    const auto row = static_cast<std::size_t>(j);
    const std::ptrdiff_t from = places.offsets[row] + permutation.first;
    const auto along = [&](const std::uint8_t* plane, std::ptrdiff_t offset) HWY_ATTR -> Words {
        const __m512i voxels = voxels_at<narrow>(plane + from + offset, permutation.needed);
        const __m512i corners = _mm512_permutexvar_epi8(permutation.voxels, voxels);
        const __m512i codes = _mm512_maddubs_epi16(corners, permutation.weights);
        if constexpr (!blanks) {
            return {codes, codes};
        }
        const __m512i all = _mm512_movm_epi8(_mm512_test_epi8_mask(corners, corners));
        return {codes, _mm512_maddubs_epi16(all, permutation.weights)};
    };
    if (slab.ahead.lines > 0) {
        // It was fetched no nearer than the second cache: what the next row of pixels but one lies between.
        const std::uint8_t* const next = slice.voxels + places.offsets[row + 2] + permutation.first;
        for (const std::uint8_t* const line : {next, next + slab.stride}) {
            __builtin_prefetch(line);
            __builtin_prefetch(line + permuted_voxels - 1);
        }
    }
    Words before = along(slice.voxels, 0);
    Words behind = along(slice.voxels, slab.stride);
    if (slice.next != nullptr) {
        const auto add_half = [](Words& to, const Words& more) HWY_ATTR {
            to = {_mm512_avg_epu16(to.codes, more.codes), _mm512_avg_epu16(to.valid, more.valid)};
        };
        add_half(before, along(slice.next, 0));
        add_half(behind, along(slice.next, slab.stride));
    }
    const __m512i weight = _mm512_set1_epi32(places.weights[row]);
    const __m512i codes = between_rows(before.codes, behind.codes, weight);
    if constexpr (blanks) {
        return mean_of_valid(codes, between_rows(before.valid, behind.valid, weight));
    }
    return {codes, ~0U};
}

}  // namespace shearwater::shear::HWY_NAMESPACE
HWY_POP_ATTRIBUTES
HWY_AFTER_NAMESPACE();

#endif
#endif
