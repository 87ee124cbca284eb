#pragma once
// The inner loop: the samples of a few slices over some intermediate pixels.
//
//              fast ->            voxels of a slice: adjacent along its fast axis, rows `stride` apart
//   slow  o-----o-----o-----o
//    |       .  .  .  .           samples: pixel (i, j)'s lies at (fast_offset + i * fast_scale,
//    v    o-----o-----o-----o     slow_offset + j * slow_scale) in the cube's voxels
//            .  .  .  .
//
// A slice lies on a plane of voxels, or half-way to the next. Where in a cell a sample lies is rounded to
// whole cell_steps, from what does not depend on how the cube is divided into bricks, nor the image into
// tiles.

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/view/factorisation.h"
#include "renderer/shear/opacity_table.h"

namespace shearwater::shear {

template <class Code>
struct Slice {
    const Code* voxels;  // that of the slab's first voxel on the plane at the slice or before it
    const Code* next;    // the next plane of voxels where the slice lies half-way to it, else null
    double fast_offset, fast_scale;
    double slow_offset, slow_scale;
    view::Rect pixels;  // whose samples are wanted, half-open, counted from the tile's first
    // The length that a sample stands for on each ray, laid out as Rays, in OpacityTable::depth_unit().
    const float* lengths;
};

// Memory that will be wanted soon, to be fetched meanwhile: so many pieces of so many lines of the cache.
struct Ahead {
    const char* first = nullptr;
    std::ptrdiff_t row_stride = 0, plane_stride = 0;  // bytes
    int lines = 0, rows = 0, planes = 0;

    int count() const { return lines * rows * planes; }
};
inline constexpr int cache_line = 64;

// Slices that follow one another front to back.
template <class Code>
struct Slab {
    static constexpr int max_slices = 8;
    // Of segments (segments.h): with the slice that the last one's end lies on.
    static constexpr int max_ends = max_slices + 1;

    std::int64_t fast_first, slow_first;  // its first voxel
    std::int64_t fast_cells, slow_cells;  // a row holds one voxel more, and there is one row more
    std::ptrdiff_t stride;                // from row to row
    Ahead ahead;
    int fast_pixel, slow_pixel;  // the tile's first pixel
    bool blanks;                 // whether code 0, which is no value, occurs
    bool between_nodes;          // whether extinction is interpolated, or that of the nearest node will do
    bool faint;                  // whether no sample's optical depth exceeds few_halvings
    int count;
    std::array<Slice<Code>, max_ends> slices;
};
// Bytes beyond the last row that may be read, though to no effect.
inline constexpr std::size_t voxel_padding = 1024;

// What the rays of a tile have gathered so far, premultiplied. One array each, `stride` from row to row,
// with ray_padding floats beyond every row's last that may be read and written back unchanged. With a table
// in one hue, r is how much of it, and g and b are left alone.
struct Rays {
    float *r, *g, *b, *a;
    std::ptrdiff_t stride;
    float done = view::opaque_enough;  // what has gathered so much opacity takes no more samples
};
inline constexpr int ray_padding = 32;
// A tile's pixels along the fast and along the slow axis.
inline constexpr int widest_tile = 128;
inline constexpr int tallest_tile = 80;

// What of a sample's corners has to be valid: one half, which rounding does not undo.
inline constexpr float least_valid = 0.4999F;
// Optical depths up to this many halvings of light are easy to make opacities of.
inline constexpr float few_halvings = 0.25F;
// Samples lie on whole steps of this many from one voxel to the next.
inline constexpr int cell_steps = 127;

// Puts the samples of every slice behind the rays of its pixels. A sample is interpolated bilinearly, on
// slices half-way between the two; with blanks it is the mean of its valid corners, and transparent where
// they weigh less than one half. Returns the number of samples taken: rays that are done before take none.
template <class Code>
std::uint64_t composite_slab(const Slab<Code>& slab, const OpacityTable& table, const Rays& rays);

// Its definition, one sample after the other; the other gives the same within rounding.
template <class Code>
std::uint64_t composite_slab_by_definition(const Slab<Code>& slab, const OpacityTable& table,
                                           const Rays& rays);

// The code of pixel (i, j)'s sample on a slice of the slab, interpolated by definition; 0 where it is blank.
template <class Code>
float sample_by_definition(const Slab<Code>& slab, const Slice<Code>& slice, int i, int j);

extern template float sample_by_definition(const Slab<std::uint8_t>&, const Slice<std::uint8_t>&, int, int);
extern template float sample_by_definition(const Slab<std::uint16_t>&, const Slice<std::uint16_t>&, int, int);
extern template std::uint64_t composite_slab_by_definition(const Slab<std::uint8_t>&, const OpacityTable&,
                                                           const Rays&);
extern template std::uint64_t composite_slab_by_definition(const Slab<std::uint16_t>&, const OpacityTable&,
                                                           const Rays&);

}  // namespace shearwater::shear
