#pragma once
// The inner loop: the samples of one slice of one brick along one row of intermediate pixels. This is its
// scalar form, and its definition: any faster form gives the same within rounding.
//
//   row1  o-----o-----o-----o      voxels of the slice, `stride` apart along u
//              .  .  .  .          samples: pixel n's lies at u + n * u_scale, v_fraction from row0 to row1
//   row0  o-----o-----o-----o

#include <cstddef>
#include <cstdint>
#include <span>

#include "renderer/shear/opacity_table.h"

namespace shearwater::shear {

template <class Code>
struct VoxelRows {
    const Code* row0;
    const Code* row1;
    std::ptrdiff_t stride;
    int cells;         // a row holds cells + 1 voxels
    float v_fraction;  // in [0, 1]
    float u;           // of the first pixel, in voxels from the row's first
    float u_scale;     // per pixel, of either sign
};

// What rays have gathered so far, premultiplied, one array per channel and one ray per pixel.
struct RaySpan {
    float* r;
    float* g;
    float* b;
    float* a;
};

// A ray with less light left than this is done: well below half a level of 255.
inline constexpr float opaque_enough = 1 - 1.0F / 4096;

// 1 - exp(-x) for x >= 0, accurate for tiny x too: optical depths add up over a thousand slices.
inline float opacity_of(float depth) {
    const float x = (depth < 16 ? depth : 16.0F) * (1.0F / 16);
    // Taylor's series on [0, 1], then 1 - exp(-2x) = e (2 - e) four times.
    float e =
        x *
        (1 -
         x * (1.0F / 2) *
             (1 - x * (1.0F / 3) *
                      (1 - x * (1.0F / 4) *
                               (1 - x * (1.0F / 5) *
                                        (1 - x * (1.0F / 6) *
                                                 (1 - x * (1.0F / 7) *
                                                          (1 - x * (1.0F / 8) * (1 - x * (1.0F / 9)))))))));
    for (int i = 0; i < 4; ++i) {
        e *= 2 - e;
    }
    return e;
}

// Puts one sample behind each of lengths.size() rays. lengths: the world length each sample stands for.
// With `blanks`, code 0 is no value: a sample is the mean of its valid corners, and transparent where
// they weigh less than one half. Returns the number of samples taken: rays that are done take none.
template <class Code, bool blanks>
int composite_span(const VoxelRows<Code>& voxels, std::span<const float> lengths, const OpacityTable& table,
                   const RaySpan& rays);

extern template int composite_span<std::uint8_t, false>(const VoxelRows<std::uint8_t>&,
                                                        std::span<const float>, const OpacityTable&,
                                                        const RaySpan&);
extern template int composite_span<std::uint8_t, true>(const VoxelRows<std::uint8_t>&, std::span<const float>,
                                                       const OpacityTable&, const RaySpan&);
extern template int composite_span<std::uint16_t, false>(const VoxelRows<std::uint16_t>&,
                                                         std::span<const float>, const OpacityTable&,
                                                         const RaySpan&);
extern template int composite_span<std::uint16_t, true>(const VoxelRows<std::uint16_t>&,
                                                        std::span<const float>, const OpacityTable&,
                                                        const RaySpan&);

}  // namespace shearwater::shear
