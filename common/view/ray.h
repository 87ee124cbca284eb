#pragma once
// One ray of a picture, for what is asked of a single pixel: its own factorisation, and where along it what
// is seen there lies.
//
//   opacity so far   0 ............ half of the ray's ............ all of the ray's
//   ray              o--.--.--.--:--.--.--|--.--.--.--.--.--.--.--o   samples, one a slice
//                    enters the cube      what is seen there      leaves it

#include <optional>
#include <span>

#include "common/view/factorisation.h"

namespace shearwater::view {

// The factorisation of the ray through (x, y) of a picture, whose pixel centres lie at halves: one face of
// one pixel, with two slices a voxel, whatever the quality of pictures. The camera is valid for the size; where
// it is so far out that the ray has no bounds, validate() does not pass what comes of it.
Factorisation factorise_ray(const Camera& camera, const ImageSize& size, const Vec2& at,
                            const Lattice& lattice);
// Whether a factorisation is one of a single ray.
bool is_ray(const Factorisation& factorisation);

// The optical depth that a sample stands for: from half-way to the slice before it to half-way to the next,
// or as far as the ray is in the cube.
struct RaySample {
    std::int64_t slice = 0;
    float depth = 0;  // above 0
    bool operator==(const RaySample&) const = default;
};

struct RayHit {
    Vec3 voxel;          // where, in voxel space
    double opacity = 0;  // of the whole ray
};
// Where the opacity gathered along a ray, front to back, reaches half of the ray's. Nothing where all of it
// is less than half a level of 255, and so is not seen. The samples are those of all leaves, front to back.
std::optional<RayHit> half_way(const Factorisation& ray, std::span<const RaySample> samples);

}  // namespace shearwater::view
