#pragma once
// The noise of a radio interferometer's map.

#include <cstdint>
#include <span>
#include <vector>

namespace shearwater::samples {

// Noise correlated over the synthesised beam and over neighbouring channels, that rises outwards as the
// primary beam falls. Where that has fallen below half the map is blank.
class RadioNoise {
  public:
    // Planes of nx by ny pixels; `beam` is the beam's deviation in pixels.
    RadioNoise(std::int64_t nx, std::int64_t ny, float beam, std::uint64_t seed);

    float beam() const { return beam_; }

    // Adds the noise of channel z, of deviation `level` in the middle, and blanks the corners.
    void add(std::int64_t z, float level, std::span<float> plane) const;

  private:
    void fill_white(std::int64_t y, std::int64_t z, std::span<float> row) const;

    std::int64_t nx_, ny_;
    float beam_;
    std::uint64_t seed_;
    std::vector<float> kernel_;  // along one axis, of unit power
};

}  // namespace shearwater::samples
