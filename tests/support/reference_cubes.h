#pragma once
// Cubes made by formula, and read as a file would be.

#include <functional>
#include <vector>

#include "common/base/workers.h"
#include "common/volume/mapping.h"
#include "common/volume/source.h"
#include "renderer/shear/brick_volume.h"

namespace shearwater::test {

// A cube of floats in memory, axis 0 fastest, NaN for blank.
class FloatCube final : public volume::VoxelSource {
  public:
    explicit FloatCube(const volume::Index3& n);
    FloatCube(const volume::Index3& n, const std::function<float(double, double, double)>& value);

    const volume::Index3& n() const { return n_; }
    float& at(std::int64_t x, std::int64_t y, std::int64_t z) { return values_[index(x, y, z)]; }
    float at(std::int64_t x, std::int64_t y, std::int64_t z) const { return values_[index(x, y, z)]; }
    std::vector<float>& values() { return values_; }
    const std::vector<float>& values() const { return values_; }

    base::Status read(const volume::Box& box, std::span<float> out) override;
    bool concurrent() const override { return true; }

  private:
    std::size_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
        return static_cast<std::size_t>((z * n_[1] + y) * n_[0] + x);
    }

    volume::Index3 n_;
    std::vector<float> values_;
};

// Values from 0 to 1: a few broad Gaussians and waves of long period, different for every seed.
FloatCube smooth_cube(const volume::Index3& n, unsigned seed = 1);
// Independent values, uniform in [0, 1).
FloatCube noise_cube(const volume::Index3& n, unsigned seed = 1);
// The cube with one voxel of so many blank, along its rows.
FloatCube blanked(FloatCube cube, std::size_t one_of);
// The cube whose axis a is axis from[a] of the given one.
FloatCube permuted(const FloatCube& cube, const std::array<int, 3>& from);

// Bricks of a box of it (by default the whole), with values 0 to 1 mapped to s = 0 to 1.
shear::BrickVolume bricks_of(FloatCube& cube, base::Workers& workers, const volume::Mapping& mapping = {});
shear::BrickVolume bricks_of(FloatCube& cube, const volume::Box& box, base::Workers& workers,
                             const volume::Mapping& mapping = {});

}  // namespace shearwater::test
