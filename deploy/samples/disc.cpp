#include "deploy/samples/disc.h"

#include <algorithm>
#include <cmath>

#include "deploy/samples/noise.h"

namespace shearwater::samples {

namespace {

struct Tilt {
    float inclination, angle;
};

Tilt tilt_at(const Disc& disc, float r) {
    const float share = std::clamp((r / disc.radius - 0.55F) / 0.45F, 0.0F, 1.2F);
    const float bend = share * share * (1.5F - 0.5F * share);
    return {disc.inclination + disc.warp_inclination * bend, disc.position_angle + disc.warp_angle * bend};
}

// The azimuth relative to the logarithmic spiral of the arms.
float arm_phase(const Disc& disc, const DiscPlace& place) {
    return place.azimuth - std::log(std::max(place.r, 1.0F) / 5) / std::tan(disc.pitch);
}

}  // namespace

std::optional<DiscPlace> place_seen_at(const Disc& disc, float x, float y) {
    const float dx = x - disc.x;
    const float dy = y - disc.y;
    DiscPlace place{std::hypot(dx, dy), 0};
    constexpr int steps = 24;
    for (int step = 0; step < steps; ++step) {
        const Tilt tilt = tilt_at(disc, place.r);
        const float along = dx * std::cos(tilt.angle) + dy * std::sin(tilt.angle);
        const float across =
            (dy * std::cos(tilt.angle) - dx * std::sin(tilt.angle)) / std::cos(tilt.inclination);
        place.azimuth = std::atan2(across, along);
        place.r = 0.5F * (place.r + std::hypot(along, across));
    }
    if (place.r > 1.3F * disc.radius) {
        return std::nullopt;
    }
    return place;
}

SkyPlace appearance(const Disc& disc, const DiscPlace& place) {
    const Tilt tilt = tilt_at(disc, place.r);
    const float along = place.r * std::cos(place.azimuth);
    const float across = place.r * std::sin(place.azimuth) * std::cos(tilt.inclination);
    constexpr float streaming = 9;
    const float rotation = disc.speed * (1 - std::exp(-place.r / disc.turnover));
    const float stream =
        streaming * disc.contrast * 0.5F * std::sin(static_cast<float>(disc.arms) * arm_phase(disc, place));
    const float v = disc.v + std::sin(tilt.inclination) *
                                 (rotation * std::cos(place.azimuth) + stream * std::sin(place.azimuth));
    return {disc.x + along * std::cos(tilt.angle) - across * std::sin(tilt.angle),
            disc.y + along * std::sin(tilt.angle) + across * std::cos(tilt.angle), v};
}

float arm_strength(const Disc& disc, const DiscPlace& place) {
    const float phase = static_cast<float>(disc.arms) * arm_phase(disc, place);
    // Between the main arms run weaker ones, twice as many.
    return std::exp(disc.contrast * (std::cos(phase) - 1 + 0.3F * (std::cos(2 * phase + 1.2F) - 1)));
}

float density(const Disc& disc, const DiscPlace& place, std::uint64_t seed) {
    const float r = place.r;
    const float end = r / (0.85F * disc.radius);
    const float profile = std::exp(-r / disc.scale) *
                          (1 - 0.9F * std::exp(-(r / disc.hole) * (r / disc.hole))) *
                          std::exp(-0.5F * end * end * end * end);
    // Along the phase of the arms the clumps are fine, along the radius at constant phase long.
    const float phase = arm_phase(disc, place);
    const float fine = 0.22F * r;
    const float clumps = fractal_noise(fine * std::cos(phase), fine * std::sin(phase),
                                       1.6F * std::log(std::max(r, 1.0F)), 5, 0.7F, seed);
    return profile * arm_strength(disc, place) * std::exp(disc.clumping * clumps);
}

}  // namespace shearwater::samples
