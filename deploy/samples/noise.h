#pragma once
// Randomness by position: the same at any place whatever order it is asked for in.

#include <cstdint>

namespace shearwater::samples {

// Well mixed bits of three indices and a seed.
inline std::uint64_t hash(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
    std::uint64_t h = seed + static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15U +
                      static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fU +
                      static_cast<std::uint64_t>(z) * 0x165667b19e3779f9U;
    h = (h ^ h >> 30U) * 0xbf58476d1ce4e5b9U;
    h = (h ^ h >> 27U) * 0x94d049bb133111ebU;
    return h ^ h >> 31U;
}

// Uniform in [0, 1), from the upper 24 bits.
inline float uniform(std::uint64_t bits) {
    return static_cast<float>(bits >> 40U) * 0x1p-24F;
}

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
