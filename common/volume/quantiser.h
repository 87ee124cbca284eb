#pragma once
// Mapping::code for many values at once.

#include <cstdint>
#include <span>
#include <vector>

#include "common/volume/mapping.h"

namespace shearwater::volume {

// Gives for every float exactly the code that its mapping gives, at the speed of loading. A guess finds the
// code to within one or so; the exact thresholds between codes, found once by bisecting the mapping itself,
// put it right.
class Quantiser {
  public:
    explicit Quantiser(const Mapping& mapping);

    const Mapping& mapping() const { return mapping_; }

    // One code per value; the spans are equally long. 8-bit codes need a mapping of 8 bits.
    void codes(std::span<const float> values, std::span<std::uint8_t> out) const;
    void codes(std::span<const float> values, std::span<std::uint16_t> out) const;

    // What code a value probably has: the one that apply(stretch, (value - lo) * scale) * top + 1.5 lies in.
    struct Guess {
        static constexpr float log_factor = 0.144764827F;    // 1 / (3 ln 10)
        static constexpr float asinh_factor = 0.333530900F;  // 1 / asinh 10

        Stretch stretch;
        double lo, scale;
        float top;     // the last code but one
        float margin;  // a guess further from a threshold than this is right
        bool good;     // whether it is within half a code always
        const float* thresholds;
    };

  private:
    Guess guess() const;

    Mapping mapping_;
    // thresholds_[c] is the least float whose code is c or more; [0] and [1] are below, the one past
    // the last code is above every finite float.
    std::vector<float> thresholds_;
};

}  // namespace shearwater::volume
