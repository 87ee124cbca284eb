#include "common/volume/box.h"

#include <gtest/gtest.h>

namespace shearwater::volume {
namespace {

TEST(Box, WholeCubeStoresEveryPlane) {
    const Box box = whole({4, 5, 6});
    EXPECT_EQ(box.plane_counts(), (Index3{4, 5, 6}));
    EXPECT_EQ(box.cells(2), 5);
    EXPECT_EQ(box.voxels(), 120);
}

TEST(Box, ContainsItselfAndItsPartsOnly) {
    const Box box{{0, 0, 0}, {9, 9, 9}};
    EXPECT_TRUE(box.contains(box));
    EXPECT_TRUE(box.contains({{1, 2, 3}, {4, 9, 4}}));
    EXPECT_FALSE(box.contains({{-1, 0, 0}, {9, 9, 9}}));
    EXPECT_FALSE(box.contains({{0, 0, 0}, {9, 9, 10}}));
}

TEST(Box, IsWrittenAxisByAxis) {
    EXPECT_EQ(to_string(Box{{0, 1, 2}, {64, 65, 66}}), "[0,64) x [1,65) x [2,66)");
}

TEST(Box, VoxelCountRefusesWhatDoesNotFit) {
    const std::int64_t big = std::int64_t{1} << 21;
    EXPECT_EQ(voxel_count({big, big, big / 2}), std::int64_t{1} << 62);
    EXPECT_EQ(voxel_count({big, big, big}), -1);
    EXPECT_EQ(voxel_count({big * big, big * big, 0}), 0);
    EXPECT_EQ(voxel_count({2, -1, 2}), -1);
    EXPECT_EQ(voxel_count({3, 5, 7}), 105);
}

}  // namespace
}  // namespace shearwater::volume
