#pragma once
// Mapping::code for many values at once.

#include <cstdint>
#include <span>
#include <vector>

#include "common/volume/mapping.h"

namespace shearwater::volume {

// Gives for every float exactly the code that its mapping gives, at the speed of loading. A single
// precision guess finds the code to within one or so; the exact thresholds between codes, found once
// by bisecting the mapping itself, put it right.
class Quantiser {
  public:
    explicit Quantiser(const Mapping& mapping);

    const Mapping& mapping() const { return mapping_; }

    // One code per value; the spans are equally long. 8-bit codes need a mapping of 8 bits.
    void codes(std::span<const float> values, std::span<std::uint8_t> out) const;
    void codes(std::span<const float> values, std::span<std::uint16_t> out) const;

  private:
    template <Stretch stretch, class Code>
    void run(std::span<const float> values, std::span<Code> out) const;
    template <class Code>
    void dispatch(std::span<const float> values, std::span<Code> out) const;

    Mapping mapping_;
    // thresholds_[c] is the least float whose code is c or more; [0] and [1] are below, the one past
    // the last code is above every finite float.
    std::vector<float> thresholds_;
};

}  // namespace shearwater::volume
