#pragma once
// Normal deviates by table: as cheap as a look-up, with tails as long as the bits reach.

#include <cstdint>
#include <vector>

namespace shearwater::synthetic {

// The x < 0 below which a normal deviate lies with probability p, 0 < p <= 0.5.
double normal_quantile(double p);

// Turns uniform bits into a deviate of mean 0 and deviation 1 by the inverse of its distribution: linear
// in each of 4096 equally likely cells, but exact in the outermost two, where the line would end.
class Normal {
  public:
    Normal();

    float operator()(std::uint64_t bits) const {
        const std::uint64_t cell = bits >> 52U;
        if (cell == 0 || cell == cells - 1) {
            return tail(bits);
        }
        const float t = static_cast<float>(static_cast<std::int32_t>(bits >> 28U & 0xffffffU)) * 0x1p-24F;
        return edges_[cell] + t * (edges_[cell + 1] - edges_[cell]);
    }

  private:
    static constexpr std::uint64_t cells = 4096;
    static float tail(std::uint64_t bits);

    std::vector<float> edges_;
};

}  // namespace shearwater::synthetic
