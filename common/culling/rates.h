#pragma once
// How opacity functions keep what a block has of a basis: one byte, rounded down. Code 0 is 0; the others are
// steps of 3 % up to `greatest`, that of a block where the basis' shape is 1 throughout.
//
// A rate is a mean extinction in the world, the basis being at the least height (family.h), over that height:
// nearly the mean of its shape.

#include <cmath>
#include <cstdint>

namespace shearwater::culling {

inline constexpr double greatest_rate = 1 - 1.0 / 512;
inline constexpr double rate_octaves = 12;
inline constexpr int most_code = 255;

inline double rate_of(int code) {
    return code <= 0 ? 0 : greatest_rate * std::exp2((code - most_code) * rate_octaves / (most_code - 1));
}

// The greatest code whose rate is no more.
inline std::uint8_t code_below(double rate) {
    if (rate < rate_of(1)) {
        return 0;
    }
    const double steps = std::floor(std::log2(rate / greatest_rate) * (most_code - 1) / rate_octaves);
    int code = steps >= 0 ? most_code : most_code + static_cast<int>(steps);
    while (code > 0 && rate_of(code) > rate) {
        --code;  // the logarithm was rounded up
    }
    return static_cast<std::uint8_t>(code);
}

}  // namespace shearwater::culling
