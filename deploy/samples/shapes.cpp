// The samples whose pictures are known by formula.

#include <algorithm>
#include <cmath>

#include "deploy/samples/formula.h"
#include "deploy/samples/noise.h"

namespace shearwater::samples {

namespace {

// 1 everywhere: with the limits 0 and 2 it is s = 0.5 throughout.
class Slab final : public Formula {
  public:
    Description description() const override {
        return {.object = "slab", .unit = "", .axes = {}, .keywords = {}};
    }
    void plane(std::int64_t, std::span<float> out) const override { std::fill(out.begin(), out.end(), 1.0F); }
};

// 1 within 0.4 of the shortest axis' voxels around the cube's middle, 0 outside, and a straight slope
// one voxel wide between.
class Ball final : public Formula {
  public:
    explicit Ball(const volume::Index3& n)
        : n_(n), radius_(0.4 * static_cast<double>(std::min({n[0], n[1], n[2]}))) {}

    Description description() const override {
        return {.object = "ball", .unit = "", .axes = {}, .keywords = {}};
    }

    void plane(std::int64_t z, std::span<float> out) const override {
        std::size_t i = 0;
        for (std::int64_t y = 0; y < n_[1]; ++y) {
            for (std::int64_t x = 0; x < n_[0]; ++x) {
                const double r = std::hypot(from_middle(x, 0), from_middle(y, 1), from_middle(z, 2));
                out[i++] = static_cast<float>(std::clamp(radius_ - r + 0.5, 0.0, 1.0));
            }
        }
    }

  private:
    double from_middle(std::int64_t index, std::size_t axis) const {
        return static_cast<double>(index) - static_cast<double>(n_[axis] - 1) / 2;
    }

    volume::Index3 n_;
    double radius_;
};

// Independent values, uniform in [0, 1).
class Random final : public Formula {
  public:
    Random(const volume::Index3& n, std::uint64_t seed) : n_(n), seed_(seed) {}

    Description description() const override {
        return {.object = "random", .unit = "", .axes = {}, .keywords = {}};
    }

    void plane(std::int64_t z, std::span<float> out) const override {
        std::size_t i = 0;
        for (std::int64_t y = 0; y < n_[1]; ++y) {
            for (std::int64_t x = 0; x < n_[0]; ++x) {
                out[i++] = uniform(hash(x, y, z, seed_));
            }
        }
    }

  private:
    volume::Index3 n_;
    std::uint64_t seed_;
};

}  // namespace

std::unique_ptr<Formula> make_slab(const volume::Index3&) {
    return std::make_unique<Slab>();
}

std::unique_ptr<Formula> make_ball(const volume::Index3& n) {
    return std::make_unique<Ball>(n);
}

std::unique_ptr<Formula> make_random(const volume::Index3& n, std::uint64_t seed) {
    return std::make_unique<Random>(n, seed);
}

}  // namespace shearwater::samples
