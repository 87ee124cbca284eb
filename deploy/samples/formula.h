#pragma once
// What a sample is to the writer: planes of values and what the header says of them.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/volume/box.h"

namespace shearwater::samples {

// One axis of the world coordinates: value = at + step * (pixel - pixel_at), pixels from 1.
struct WorldAxis {
    std::string type;
    std::string unit;
    double at = 0;
    double pixel_at = 1;
    double step = 1;
};

struct Description {
    std::string object;
    std::string unit;
    std::vector<WorldAxis> axes;                           // three, or none
    std::vector<std::pair<std::string, double>> keywords;  // more numbers, such as the beam
};

class Formula {
  public:
    virtual ~Formula() = default;
    virtual Description description() const = 0;
    // Fills `out` with the n[0] * n[1] values of plane z, axis 0 fastest. From several threads at once.
    virtual void plane(std::int64_t z, std::span<float> out) const = 0;
};

// One of synthetic::kinds(); null for any other name.
std::unique_ptr<Formula> make_synthetic(std::string_view name, const volume::Index3& n, std::uint64_t seed);
std::unique_ptr<Formula> make_hi_galaxy(const volume::Index3& n, std::uint64_t seed);
std::unique_ptr<Formula> make_cosmic_web(const volume::Index3& n, std::uint64_t seed);

}  // namespace shearwater::samples
