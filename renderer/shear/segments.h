#pragma once
// The inner loop of pre-integrated classification: the segments of rays between slices that follow one
// another.
//
//     eye --- in ---o---------o---------o-- out      o: samples, interpolated as kernel.h has it
//                entry  segment  segment  exit
//
// A segment reaches from the sample on one slice to that on the next, and belongs to whoever owns its front
// sample. A ray comes into the cube and leaves it between slices: what lies before its first sample and
// behind its last is a segment whose two ends are that sample. So a ray's segments cover what it has of the
// cube exactly, as the lengths of samples do (FacePlan::shares).
//
// Of a segment with one valid end, half the length counts, classified by that end alone: as much as that
// sample would stand for on this side. One without any is transparent.
//
// In a perspective view some rays beside a face's part of the picture, which only the warp's filter reaches,
// move sideways by more than a voxel from slice to slice, farther than a sub-volume's margin goes. Both ends
// of their segments are one sample, for the length that it stands for: they are classified after
// interpolation.

#include <array>
#include <cstdint>

#include "renderer/shear/kernel.h"
#include "renderer/shear/segment_table.h"

namespace shearwater::shear {

struct Segment {
    int front, back;    // which of the slices
    view::Rect pixels;  // half-open, counted from the tile's first; inside those of both slices
    // World length on each ray, laid out as Rays.
    const float* lengths;
};

// Segments front to back, and the slices, front to back too, that they reach between: of these, `lengths` and
// the slab's `between_nodes` are not used.
template <class Code>
struct SegmentSlab {
    // Of a slice: a whole step, and up to four of each of entries, exits and those that move too far.
    static constexpr int most_of_a_slice = 13;
    static constexpr int max_segments = most_of_a_slice * Slab<Code>::max_slices;

    Slab<Code> samples;
    int count = 0;
    std::array<Segment, max_segments> segments;
};

// Puts every segment behind the rays of its pixels. Returns the number of segments taken: rays that are done
// before take none.
template <class Code>
std::uint64_t composite_segments(const SegmentSlab<Code>& slab, const SegmentTable& table, const Rays& rays);

// Its definition, one segment after the other; the other gives the same within rounding.
template <class Code>
std::uint64_t composite_segments_by_definition(const SegmentSlab<Code>& slab, const SegmentTable& table,
                                               const Rays& rays);

extern template std::uint64_t composite_segments_by_definition(const SegmentSlab<std::uint8_t>&,
                                                               const SegmentTable&, const Rays&);
extern template std::uint64_t composite_segments_by_definition(const SegmentSlab<std::uint16_t>&,
                                                               const SegmentTable&, const Rays&);

}  // namespace shearwater::shear
