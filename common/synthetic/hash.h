#pragma once
// Randomness by position: the same at any place whatever order it is asked for in.

#include <cstdint>

namespace shearwater::synthetic {

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

}  // namespace shearwater::synthetic
