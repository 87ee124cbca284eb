// Pre-integrated classification: a tile's segments from slice to slice.

#include <algorithm>
#include <functional>
#include <utility>

#include "renderer/shear/segments.h"
#include "renderer/shear/tile.h"

namespace shearwater::shear {

using view::Rect;
using view::SliceMap;

// Collects the segments of slices that are added front to back, until there is no room for another's.
template <class Code>
class Tile<Code>::Segments {
  public:
    explicit Segments(Tile& tile) : tile_(tile), plan_(tile.plan_), planes_(*tile.planes_) { clear(); }

    bool has_room() const { return slab.samples.count + 2 <= Slab<Code>::max_ends; }

    // Those whose front samples lie on slice k under some pixels.
    void add(std::int64_t k, const Rect& pixels) {
        const int front = slice_of(k, pixels);
        const Rect gentle = intersection(pixels, here(plan_.gentle()));
        if (pixels != gentle) {
            const float* const lengths = tile_.lengths_on(k, pixels, static_cast<std::size_t>(front));
            for (const Rect& part : left_over(pixels, gentle)) {
                if (!part.empty()) {
                    add({front, front, part, lengths});
                }
            }
        }
        // Every ray comes in before one slice, and goes out behind one: a plane has room for all of a tile's.
        const auto rims = [&](const Rect& part, Plane& lengths, auto write) {
            if (!part.empty()) {
                (plan_.*write)(k, tile_.in_face(part), tile_.lengths_in(lengths));
                add({front, front, part, lengths.data()});
            }
        };
        for (const Rect& part : left_over(gentle, here(plan_.inside(plan_.before(k))))) {
            rims(part, planes_.entries, &FacePlan::write_entries);
        }
        const Rect whole = intersection(gentle, here(plan_.inside(plan_.behind(k))));
        if (!whole.empty()) {
            add({front, slice_of(plan_.behind(k), whole), whole, planes_.steps.data()});
        }
        for (const Rect& part : left_over(gentle, whole)) {
            rims(part, planes_.exits, &FacePlan::write_exits);
        }
    }

    void clear() { slab.count = slab.samples.count = 0; }

    SegmentSlab<Code> slab;
    std::array<std::int64_t, Slab<Code>::max_ends> numbers;  // of the slab's slices

  private:
    // Counted from the tile's first.
    Rect here(const Rect& rect) const {
        const Rect& all = tile_.rect_;
        return {rect.x0 - all.x0, rect.y0 - all.y0, rect.x1 - all.x0, rect.y1 - all.y0};
    }
    void add(const Segment& segment) { slab.segments[static_cast<std::size_t>(slab.count++)] = segment; }
    // Which slice of the slab is slice k, whose samples are wanted under some more pixels.
    int slice_of(std::int64_t k, const Rect& pixels) {
        int& count = slab.samples.count;
        const auto last = static_cast<std::size_t>(count);
        if (count > 0 && numbers[last - 1] == k) {
            Rect& wanted = slab.samples.slices[last - 1].pixels;
            wanted = bounding(wanted, pixels);
            return count - 1;
        }
        const SliceMap map = plan_.node_map(plan_.node_place(k));
        numbers[last] = k;
        slab.samples.slices[last] = {.voxels = nullptr,
                                     .next = nullptr,
                                     .fast_offset = map.u_offset,
                                     .fast_scale = map.u_scale,
                                     .slow_offset = map.v_offset,
                                     .slow_scale = map.v_scale,
                                     .pixels = pixels,
                                     .lengths = nullptr};
        return count++;
    }
    Tile& tile_;
    const FacePlan& plan_;
    Planes& planes_;
};

template <class Code>
void Tile<Code>::render_segments(Slices slices, std::span<const std::int64_t> numbers, Visit visit,
                                 bool whole) {
    Segments segments(*this);
    std::uint64_t taken = 0;
    const auto flush = [&] {
        SegmentSlab<Code>& slab = segments.slab;
        const auto count = static_cast<std::size_t>(slab.samples.count);
        const Slices ends = Slices(slab.samples.slices).first(count);
        const auto numbers_of_ends = std::span<const std::int64_t>(segments.numbers).first(count);
        slab.samples =
            slab_of(ends, numbers_of_ends, region_of(ends, numbers_of_ends, nodes_of(nodes_)), visit, whole);
        taken += composite_segments(slab, *classification_.segments, rays());
        segments.clear();
    };
    for (std::size_t n = 0; n < slices.size(); ++n) {
        if (!segments.has_room()) {
            flush();
        }
        segments.add(numbers[n], slices[n].pixels);
    }
    flush();
    samples_ += taken;
    if (taken > 0) {
        note_met(region_of(slices, numbers, nodes_of(codes_.own())));
    }
}

template void Tile<std::uint8_t>::render_segments(Slices, std::span<const std::int64_t>, Visit, bool);
template void Tile<std::uint16_t>::render_segments(Slices, std::span<const std::int64_t>, Visit, bool);

}  // namespace shearwater::shear
