#pragma once
// A rotating gas disc of tilted rings, as it is seen on the sky.

#include <cstdint>
#include <optional>

namespace shearwater::samples {

// Lengths in sky units, angles in radians, velocities in km/s.
struct Disc {
    float x, y;            // middle
    float v;               // systemic velocity
    float inclination;     // 0 is face-on
    float position_angle;  // of the receding half of the major axis, from +x
    float radius;          // where the gas ends
    float scale;           // e-folding length of the density
    float hole;            // radius of the central depression
    float speed;           // of the flat rotation curve
    float turnover;        // radius in which it rises
    int arms;
    float pitch;             // of the arms
    float contrast;          // of the arms: 0 is none
    float clumping;          // deviation of the logarithm of the density by clumps
    float warp_inclination;  // change of the angles from 0.55 of the radius outwards
    float warp_angle;
};

// A place in the disc: its radius and azimuth in the plane of its ring.
struct DiscPlace {
    float r, azimuth;
};

struct SkyPlace {
    float x, y;
    float v;
};

// Where a line of sight meets the disc, found by going from ring to ring; unset beyond its end.
std::optional<DiscPlace> place_seen_at(const Disc& disc, float x, float y);

// Where a place of the disc appears, and its velocity along the line of sight, streaming along the
// arms included.
SkyPlace appearance(const Disc& disc, const DiscPlace& place);

// 1 on the ridge of an arm, less between.
float arm_strength(const Disc& disc, const DiscPlace& place);

// The surface density there: smooth profile, arms and clumps sheared along them; 1 in size.
float density(const Disc& disc, const DiscPlace& place, std::uint64_t seed);

}  // namespace shearwater::samples
