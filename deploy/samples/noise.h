#pragma once
// Randomness by position: the same at any place whatever order it is asked for in.

#include <cstdint>

#include "common/synthetic/hash.h"

namespace shearwater::samples {

using synthetic::hash;
using synthetic::uniform;

// Close to normal, of mean 0 and deviation 1: the sum of four uniform parts of the bits.
inline float normal(std::uint64_t bits) {
    const auto part = [bits](unsigned shift) { return static_cast<float>(bits >> shift & 0xffffU); };
    return (part(0) + part(16) + part(32) + part(48) - 2 * 65535.0F) * (1.7320508F / 65536);
}

// Smooth noise of about unit wavelength and deviation, mean 0.
float smooth_noise(float x, float y, float z, std::uint64_t seed);

// Octaves of it, each twice as fine and `gain` times as strong, scaled to about unit deviation.
float fractal_noise(float x, float y, float z, int octaves, float gain, std::uint64_t seed);

}  // namespace shearwater::samples
