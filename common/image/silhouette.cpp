#include "common/image/silhouette.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shearwater::image {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Stretch nothing{infinity, -infinity};

// Where start + slope * w is within [side.lo, side.hi].
Stretch within(double start, double slope, const Stretch& side) {
    if (slope == 0) {
        return side.contains(start) ? Stretch{-infinity, infinity} : nothing;
    }
    const double a = (side.lo - start) / slope;
    const double b = (side.hi - start) / slope;
    return {std::min(a, b), std::max(a, b)};
}

}  // namespace

Silhouette::Silhouette(const view::Factorisation& factorisation, const view::Face& face)
    : factorisation_(factorisation), face_(face) {
    for (int j = -reach; j < face.height + reach; ++j) {
        rows_.push_back(row(j));
    }
}

Stretch Silhouette::row(double j) const {
    const volume::Box shown = factorisation_.shown();
    const auto sides = [&](int axis) {
        const auto a = static_cast<std::size_t>(axis);
        return Stretch{static_cast<double>(shown.lo[a]), static_cast<double>(shown.hi[a])};
    };
    const bool perspective = factorisation_.projection == view::Projection::perspective;
    const int u = face_.u_axis();
    const int v = face_.v_axis();
    const double eye_w = factorisation_.eye[face_.axis];
    const double at_v = face_.origin.y + j * face_.pitch.y;

    // The part of the row's rays, as a stretch of w, that is in front of the eye and inside along v and w.
    Stretch w = perspective ? within(factorisation_.eye[v] - at_v * eye_w, at_v, sides(v))
                            : within(at_v, factorisation_.direction[v] / factorisation_.direction[face_.axis],
                                     sides(v));
    w = {std::max(w.lo, sides(face_.axis).lo), std::min(w.hi, sides(face_.axis).hi)};
    if (perspective) {
        (face_.sign > 0 ? w.lo : w.hi) = face_.sign > 0 ? std::max(w.lo, eye_w) : std::min(w.hi, eye_w);
    }
    if (w.hi < w.lo) {
        return nothing;
    }
    // The two sides along u, seen at both ends of it.
    Stretch at_u = nothing;
    for (const double end : {w.lo, w.hi}) {
        for (const double side : {sides(u).lo, sides(u).hi}) {
            double place = side - factorisation_.direction[u] / factorisation_.direction[face_.axis] * end;
            if (perspective) {
                // Next to the eye itself a side is seen at any slope.
                const double depth = std::max(face_.sign * (end - eye_w), 1e-12) * face_.sign;
                place = (side - factorisation_.eye[u]) / depth;
            }
            at_u = {std::min(at_u.lo, place), std::max(at_u.hi, place)};
        }
    }
    return {(at_u.lo - face_.origin.x) / face_.pitch.x, (at_u.hi - face_.origin.x) / face_.pitch.x};
}

// The rows of pixels about j say most of it, as the outline is convex: inside what joins the two next to j,
// all is inside, and outside what goes on from the two before or the two after, nothing is.
//
//   row - 1     *
//   row           *
//   j             |  * ?  *  outside
//   row + 1       *
//
// Where one of them does not meet the cube, the sums are infinite, or no number at all, and the comparisons
// with those are false or right.
bool Silhouette::contains(double i, double j) const {
    const double row_above = std::floor(j);
    const double down = j - row_above, up = 1 - down;
    const int n = static_cast<int>(row_above);
    const Stretch &before = pixel_row(n - 1), &above = pixel_row(n), &below = pixel_row(n + 1),
                  &after = pixel_row(n + 2);
    if (above.lo + (below.lo - above.lo) * down <= i && i <= above.hi + (below.hi - above.hi) * down) {
        return true;
    }
    if (i < above.lo + (above.lo - before.lo) * down || i > above.hi + (above.hi - before.hi) * down ||
        i < below.lo + (below.lo - after.lo) * up || i > below.hi + (below.hi - after.hi) * up) {
        return false;
    }
    return row(j).contains(i);
}

}  // namespace shearwater::image
