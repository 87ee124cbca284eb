#include "deploy/samples/noise.h"

#include <array>
#include <cmath>

namespace shearwater::samples {

namespace {

float fade(float t) {
    return t * t * t * (t * (6 * t - 15) + 10);
}

float mix(float a, float b, float t) {
    return a + (b - a) * t;
}

}  // namespace

float smooth_noise(float x, float y, float z, std::uint64_t seed) {
    const float x0 = std::floor(x);
    const float y0 = std::floor(y);
    const float z0 = std::floor(z);
    const auto ix = static_cast<std::int64_t>(x0);
    const auto iy = static_cast<std::int64_t>(y0);
    const auto iz = static_cast<std::int64_t>(z0);
    // At each corner of the cell a gradient, so that the noise is 0 there and slopes along it.
    const auto corner = [&](int i, int j, int k) {
        const std::uint64_t bits = hash(ix + i, iy + j, iz + k, seed);
        const auto slope = [bits](unsigned shift) {
            return static_cast<float>(static_cast<std::int32_t>(bits >> shift & 0xffffU) - 32768) *
                   (1.0F / 32768);
        };
        return slope(0) * (x - x0 - static_cast<float>(i)) + slope(16) * (y - y0 - static_cast<float>(j)) +
               slope(32) * (z - z0 - static_cast<float>(k));
    };
    const float u = fade(x - x0);
    const float v = fade(y - y0);
    const float low =
        mix(mix(corner(0, 0, 0), corner(1, 0, 0), u), mix(corner(0, 1, 0), corner(1, 1, 0), u), v);
    const float high =
        mix(mix(corner(0, 0, 1), corner(1, 0, 1), u), mix(corner(0, 1, 1), corner(1, 1, 1), u), v);
    constexpr float to_unit_deviation = 4.3F;
    return mix(low, high, fade(z - z0)) * to_unit_deviation;
}

float fractal_noise(float x, float y, float z, int octaves, float gain, std::uint64_t seed) {
    float sum = 0;
    float power = 0;
    float strength = 1;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += strength * smooth_noise(x, y, z, seed + static_cast<std::uint64_t>(octave) * 0x51ed27U);
        power += strength * strength;
        strength *= gain;
        x = 2 * x + 17.3F;
        y = 2 * y - 5.9F;
        z = 2 * z + 31.1F;
    }
    return sum / std::sqrt(power);
}

}  // namespace shearwater::samples
