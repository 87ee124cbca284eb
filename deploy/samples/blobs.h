#pragma once
// Many small clouds in position and velocity, added to planes of constant velocity.

#include <cstdint>
#include <span>
#include <vector>

namespace shearwater::samples {

// A Gaussian in x, y (voxels) and v (km/s), with its value at the middle.
struct Blob {
    float x, y, v;
    float peak;
    float width;       // deviation in voxels
    float dispersion;  // deviation in km/s
};

class Blobs {
  public:
    explicit Blobs(std::vector<Blob> blobs);

    // Adds every cloud's cut at velocity `v` to a plane of nx by ny voxels.
    void add(float v, std::int64_t nx, std::int64_t ny, std::span<float> plane) const;

  private:
    std::vector<Blob> blobs_;  // by rising velocity
    float widest_ = 0;         // the largest dispersion
};

}  // namespace shearwater::samples
