#pragma once
// A transfer function made ready for the kernel: colour and extinction on a fine grid of s.

#include <cstdint>
#include <vector>

#include "common/view/transfer_function.h"

namespace shearwater::shear {

class OpacityTable {
  public:
    // Colour, not premultiplied, and optical depth per world unit of length.
    struct Entry {
        float r, g, b, extinction;
    };
    static constexpr int entries = 4096;

    // `levels` as Mapping::levels(): codes 1 to levels stand for s from 0 to 1.
    OpacityTable(const view::TransferFunction& tf, int levels);

    // The entry nearest to an interpolated code in [1, levels] is number int(code * scale() + bias()).
    float scale() const { return scale_; }
    float bias() const { return bias_; }
    const Entry* data() const { return entries_.data(); }

    // Whether any code from min to max, interpolated ones included, has opacity.
    bool any_opacity(std::uint16_t min, std::uint16_t max) const;

  private:
    float scale_;
    float bias_;
    std::vector<Entry> entries_;
    std::vector<int> opaque_before_;  // entries with opacity before each
};

}  // namespace shearwater::shear
