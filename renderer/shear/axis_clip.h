#pragma once
// What of a ray lies between the two sides of what is shown of the cube across one in-plane axis of a face.

#include <algorithm>
#include <cstddef>
#include <limits>

#include "common/view/factorisation.h"

namespace shearwater::shear {

// Planes along a face's principal axis, in the cube's voxels.
struct Stretch {
    double from, to;
};
inline constexpr Stretch everywhere{-std::numeric_limits<double>::infinity(),
                                    std::numeric_limits<double>::infinity()};

class AxisClip {
  public:
    AxisClip(const view::Factorisation& factorisation, const view::Face& face, int axis)
        : perspective_(factorisation.projection == view::Projection::perspective),
          first_(static_cast<double>(factorisation.shown().lo[static_cast<std::size_t>(axis)])),
          last_(static_cast<double>(factorisation.shown().hi[static_cast<std::size_t>(axis)])),
          start_(perspective_ ? factorisation.eye[face.axis] : 0),
          at_(factorisation.eye[axis]),
          slope_(factorisation.direction[axis] / factorisation.direction[face.axis]) {}

    // Of a stretch of the ray of a pixel whose place along the axis is as Face counts it. At plane w the ray
    // is at  at + slope * (w - start):  in perspective its place is how fast it moves sideways; in parallel
    // all do alike.
    Stretch operator()(const Stretch& stretch, double place) const {
        const double at = perspective_ ? at_ : place;
        const double slope = perspective_ ? place : slope_;
        const double planes_per_voxel = 1 / slope;
        const double to_first = start_ + (first_ - at) * planes_per_voxel;
        const double to_last = start_ + (last_ - at) * planes_per_voxel;
        const double from = std::max(stretch.from, std::min(to_first, to_last));
        const double to = std::min(stretch.to, std::max(to_first, to_last));
        const bool along = slope == 0;
        return {along ? stretch.from : from, along ? stretch.to : to};
    }

  private:
    bool perspective_;
    double first_, last_;
    double start_, at_, slope_;
};

}  // namespace shearwater::shear
