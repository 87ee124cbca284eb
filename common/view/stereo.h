#pragma once
// Pairs of pictures for two eyes, off axis (DVR 4.2): the eyes look the same way, side by side, and share one
// projection plane, through the point where their lines of sight converge. Each sees that plane in the same
// rectangle, so that each has a frustum that is not symmetric. Cameras that are turned towards each other
// (toed in) would have two planes, and parallax up and down besides.
//
//   -----+-------*-------+-----   projection plane, `convergence` away: what lies on it has no parallax
//         \  \         /  /
//          \    \   /    /        nearer points have crossed parallax: the left eye sees them farther right;
//           \    / \    /         what is behind has it uncrossed
//            \ /     \ /
//             o-------o           the eyes, `separation` apart along the camera's right, which is half-way
//
// A point at depth z, measured along the camera's forward, whose convergence is at D, has on the plane a
// parallax, from its place for the left eye to that for the right, of
//   perspective   separation * (1 - D / z)
//   parallel      separation * (z / D - 1)
// world units: below 0 before the plane, above behind it. In a parallel view the eyes' rays go two directions
// that meet on the plane.

#include <array>

#include "common/view/camera.h"

namespace shearwater::view {

struct StereoSettings {
    // World units. Of a separation of 0 the default is a thirtieth of the convergence, which most people can
    // fuse; of a convergence of 0 it is the distance to the target.
    double separation = 0;
    double convergence = 0;
    bool swap = false;  // the left eye is shown what was the right one's, and the other way round

    static constexpr double default_share = 1.0 / 30;
    bool operator==(const StereoSettings&) const = default;
};

// The settings with their defaults for a camera put in.
StereoSettings resolved(const StereoSettings& settings, const Camera& camera);

// What the left eye is shown and what the right one is. The camera and the settings are valid.
std::array<Camera, 2> eyes_of(const Camera& camera, const StereoSettings& settings);

// How much farther to the right the second of a pair of pictures shows a point at that depth than the first:
// in pixels, of pictures of that height.
double parallax(const Camera& camera, const StereoSettings& settings, double depth, const ImageSize& size);

// Refuses what is below 0 or not finite, eyes too far apart for their convergence, and pictures that have
// more than 2^25 pixels together. The camera and size are valid.
base::Status validate(const StereoSettings& settings, const Camera& camera, const ImageSize& size);

}  // namespace shearwater::view
