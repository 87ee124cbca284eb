#pragma once
// Runs of octants in a row that are visited alike.

#include <algorithm>
#include <cstdint>
#include <vector>

namespace shearwater::shear {

// Of a micro-brick: what of it may have opacity, samples in it or segments that begin in it, and whether one
// of the voxels between which they lie is blank.
struct Content {
    std::uint8_t opaque_octants = 0;  // a bit each, counted as Octants are
    bool blanks = false;
};

// Micro-bricks or octants [first, end) along an axis, counted from where the sub-volume's first micro-brick
// begins.
struct MicroRun {
    std::int64_t first, end;
    bool operator==(const MicroRun&) const = default;
};

// What to do with the samples in a part of a layer.
enum class Visit {
    none,         // nothing: none has opacity
    full,         // all of them, or most, may have some, and no voxel is blank
    with_blanks,  // so, but voxels may be blank, which takes little more
    parts,        // it differs
};

// Octants of a row to visit alike. What is between two such and a little more work than going round it is
// visited with them.
struct OctantRun {
    MicroRun along;
    Visit visit;
};

// Whether two rows' runs are of the same octants.
inline bool alike(const std::vector<OctantRun>& a, const std::vector<OctantRun>& b) {
    return std::ranges::equal(a, b, {}, &OctantRun::along, &OctantRun::along);
}
// What to do with two parts that are visited together.
inline Visit together(Visit a, Visit b) {
    return a == b ? a : Visit::with_blanks;
}

// Those of a row of octants within `octants`, in order. content_at(n) is that of the row's n-th micro-brick,
// of which those of `micro_bricks` have some; of a micro-brick's octants the row passes two, one after the
// other.
template <class ContentAt>
void find_runs(const ContentAt& content_at, const MicroRun& micro_bricks, const MicroRun& octants, int near,
               int far, std::vector<OctantRun>& out) {
    // So many octants and fewer are not worth going round: the kernel takes more pixels at a time than lie in
    // them.
    constexpr std::int64_t bridged = 4;
    out.clear();
    const unsigned both = 1U << near | 1U << far;
    Visit between = Visit::full;  // what lies between the last run and the next
    for (std::int64_t f = std::max(octants.first / 2, micro_bricks.first);
         f < micro_bricks.end && 2 * f < octants.end; ++f) {
        const Content& content = content_at(f);
        const Visit visit = content.blanks ? Visit::with_blanks : Visit::full;
        if ((content.opaque_octants & both) == 0) {
            between = together(between, visit);
            continue;
        }
        const MicroRun seen{
            std::max(octants.first, 2 * f + ((content.opaque_octants >> near & 1) != 0 ? 0 : 1)),
            std::min(octants.end, 2 * f + ((content.opaque_octants >> far & 1) != 0 ? 2 : 1))};
        if (seen.first >= seen.end) {
            continue;
        }
        if (!out.empty() && seen.first - out.back().along.end <= bridged) {
            out.back().along.end = seen.end;
            out.back().visit = together(out.back().visit, together(between, visit));
        } else {
            out.push_back({seen, visit});
        }
        between = Visit::full;
    }
}

}  // namespace shearwater::shear
