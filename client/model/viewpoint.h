#pragma once
// How mouse, keys and numbers change where a person looks from.

#include <array>
#include <string_view>

#include "common/view/viewpoint.h"

namespace shearwater::model {

using view::max_fov;
using view::min_fov;
using view::Viewpoint;

// Lengths (dx, dy) are pixels of a picture of the given size, y downwards.

// A drag over the picture's height turns by half a circle, whatever the roll. The poles are never crossed.
void drag_orbit(Viewpoint& viewpoint, double dx, double dy, const view::ImageSize& size);
// Leans the camera to its right, so that the picture turns to the left.
void roll(Viewpoint& viewpoint, double degrees);
// By a drag about the picture's middle, at (x, y) now: the picture follows the mouse.
void drag_roll(Viewpoint& viewpoint, double x, double y, double dx, double dy, const view::ImageSize& size);
// Moves the target in the picture's plane, so that what is at the target's depth follows the mouse.
void pan(Viewpoint& viewpoint, double dx, double dy, const view::ImageSize& size,
         const view::Lattice& lattice);
// Multiplies the distance, within limits; the point at the target's depth under (x, y) stays there.
void zoom(Viewpoint& viewpoint, double factor, double x, double y, const view::ImageSize& size,
          const view::Lattice& lattice);
void toggle_projection(Viewpoint& viewpoint);
// Changes the field of view and the distance with it, so that the target keeps its size.
void set_fov(Viewpoint& viewpoint, double fov, const view::Lattice& lattice);

// Upright, from where an axis points to: from_x looks along -x.
enum class Side { from_x, from_minus_x, from_y, from_minus_y, from_z, from_minus_z };
inline constexpr std::array<std::string_view, 6> side_names{"+x", "-x", "+y", "-y", "+z", "-z"};
void look_from(Viewpoint& viewpoint, Side side);
// The whole cube in the picture, as large as it goes but for a narrow margin, seen from the same direction.
void fit(Viewpoint& viewpoint, const view::ImageSize& size, const view::Lattice& lattice);
// The target becomes a world point in front of the eye. The eye moves sideways, so that in perspective
// nothing at the point's depth changes its size; in parallel nothing does at all.
void set_pivot(Viewpoint& viewpoint, const view::Vec3& point, const view::Lattice& lattice);
// As at first, with the same projection.
void reset(Viewpoint& viewpoint);

// ---- flying: the eye moves, and turns about itself ----

// Towards the right, up and ahead, -1 to 1 each.
using Thrust = view::Vec3;
inline constexpr double min_pace = 1.0 / 64, max_pace = 64;
// In perspective, with the target near enough to be flown past in some seconds. The picture stays as it is if
// it is one in perspective.
void begin_flight(Viewpoint& viewpoint, const view::Lattice& lattice);
// At full thrust and a pace of 1, half of the distance to the target in a second.
void fly(Viewpoint& viewpoint, const Thrust& thrust, double pace, double seconds,
         const view::Lattice& lattice);
// What is in front follows the mouse.
void look_around(Viewpoint& viewpoint, double dx, double dy, const view::ImageSize& size,
                 const view::Lattice& lattice);

// ---- numbers that can be read and typed ----

enum class Number {
    azimuth,
    elevation,
    roll,  // degrees
    distance,
    height,  // of a parallel picture; world units
    fov,     // degrees
    target_x,
    target_y,
    target_z,  // world units, or voxels
};
enum class Units { world, voxels };  // of the target

double number(const Viewpoint& viewpoint, Number which, Units units, const view::Lattice& lattice);
// Angles are brought into a circle. What is not finite or out of range changes nothing; the error says what
// is allowed.
base::Status set_number(Viewpoint& viewpoint, Number which, double value, Units units,
                        const view::Lattice& lattice);

}  // namespace shearwater::model
