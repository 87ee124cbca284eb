#include "common/volume/interpolate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shearwater::volume {
namespace {

// A value linear along every axis, but for blank voxels where x is above a limit.
class Linear final : public VoxelSource {
  public:
    explicit Linear(std::int64_t blank_beyond = 1000) : blank_beyond_(blank_beyond) {}
    base::Status read(const Box& box, std::span<float> out) override {
        if (box.hi[2] > 9) {
            return base::error(base::Code::io, "read voxels", "there are no more");
        }
        EXPECT_EQ(box.voxels(), 8);
        std::size_t i = 0;
        for (std::int64_t z = box.lo[2]; z <= box.hi[2]; ++z) {
            for (std::int64_t y = box.lo[1]; y <= box.hi[1]; ++y) {
                for (std::int64_t x = box.lo[0]; x <= box.hi[0]; ++x) {
                    out[i++] = x > blank_beyond_ ? std::nanf("") : static_cast<float>(x + 10 * y + 100 * z);
                }
            }
        }
        return {};
    }

  private:
    std::int64_t blank_beyond_;
};

TEST(ValueAt, IsLinearBetweenVoxelsAndExactOnThem) {
    Linear source;
    const Index3 n{4, 5, 10};
    EXPECT_EQ(value_at(source, n, {0, 0, 0}).value(), 0);
    EXPECT_EQ(value_at(source, n, {3, 4, 9}).value(), 943);
    EXPECT_NEAR(value_at(source, n, {1.25, 2.5, 3.75}).value(), 1.25 + 25 + 375, 1e-9);
}

TEST(ValueAt, IsTheMeanOfValidCornersOrNone) {
    Linear source(1);
    const Index3 n{4, 5, 10};
    EXPECT_NEAR(value_at(source, n, {1.25, 2, 3}).value(), 321, 1e-9);
    EXPECT_TRUE(std::isnan(value_at(source, n, {1.75, 2, 3}).value()));
}

TEST(ValueAt, TellsWhatCannotBeRead) {
    Linear source;
    EXPECT_EQ(value_at(source, {4, 5, 12}, {0, 0, 10.5}).error().code, base::Code::io);
}

}  // namespace
}  // namespace shearwater::volume
