// The fields whose pictures are known by formula.

#include <algorithm>
#include <cmath>

#include "common/synthetic/make.h"
#include "common/synthetic/rows.h"

namespace shearwater::synthetic {

namespace {

// 1 everywhere: with the limits 0 and 2 it is s = 0.5 throughout.
class Slab final : public Field {
  public:
    void fill(const volume::Box&, std::span<float> out) const override {
        std::fill(out.begin(), out.end(), 1.0F);
    }
};

// 1 within 0.4 of the shortest axis' voxels around the cube's middle, 0 outside, and a straight slope
// one voxel wide between.
class Ball final : public Field {
  public:
    explicit Ball(const volume::Index3& n)
        : n_(n), radius_(0.4 * static_cast<double>(std::min({n[0], n[1], n[2]}))) {}

    void fill(const volume::Box& box, std::span<float> out) const override {
        for_each_row(box, out, [&](std::int64_t y, std::int64_t z, std::span<float> row) {
            std::int64_t x = box.lo[0];
            for (float& value : row) {
                const double r = std::hypot(from_middle(x++, 0), from_middle(y, 1), from_middle(z, 2));
                value = static_cast<float>(std::clamp(radius_ - r + 0.5, 0.0, 1.0));
            }
        });
    }

  private:
    double from_middle(std::int64_t index, std::size_t axis) const {
        return static_cast<double>(index) - static_cast<double>(n_[axis] - 1) / 2;
    }

    volume::Index3 n_;
    double radius_;
};

}  // namespace

std::unique_ptr<const Field> make_slab() {
    return std::make_unique<Slab>();
}

std::unique_ptr<const Field> make_ball(const volume::Index3& n) {
    return std::make_unique<Ball>(n);
}

}  // namespace shearwater::synthetic
