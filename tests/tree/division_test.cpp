#include "common/tree/division.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace shearwater::tree {
namespace {

using volume::Box;

std::vector<double> equal(int parts) {
    return std::vector<double>(static_cast<std::size_t>(parts), 1.0);
}

// The boxes tile the whole: each begins on the plane where the one before ends.
void expect_tiling(const Box& whole, const std::vector<Box>& boxes, int axis) {
    ASSERT_FALSE(boxes.empty());
    EXPECT_EQ(boxes.front().lo[axis], whole.lo[axis]);
    EXPECT_EQ(boxes.back().hi[axis], whole.hi[axis]);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        EXPECT_GE(boxes[i].cells(axis), 1);
        if (i > 0) {
            EXPECT_EQ(boxes[i].lo[axis], boxes[i - 1].hi[axis]);
        }
        for (int other = 0; other < 3; ++other) {
            if (other != axis) {
                EXPECT_EQ(boxes[i].lo[other], whole.lo[other]);
                EXPECT_EQ(boxes[i].hi[other], whole.hi[other]);
            }
        }
    }
}

TEST(Division, HalvesTheLongestAxisAtASharedPlane) {
    const auto boxes = divide(volume::whole({5, 9, 5}), equal(2));
    ASSERT_TRUE(boxes);
    ASSERT_EQ(boxes->size(), 2U);
    EXPECT_EQ((*boxes)[0], (Box{{0, 0, 0}, {4, 4, 4}}));
    EXPECT_EQ((*boxes)[1], (Box{{0, 4, 0}, {4, 8, 4}}));
}

TEST(Division, CutsRowsLastWhereAllAxesAreAsLong) {
    Box left = volume::whole({65, 65, 65});
    for (const int axis : {1, 2, 0}) {
        const auto boxes = divide(left, equal(2));
        ASSERT_TRUE(boxes);
        expect_tiling(left, *boxes, axis);
        left = boxes->front();
    }
    const auto rows = divide(volume::whole({66, 65, 65}), equal(2));
    ASSERT_TRUE(rows);
    expect_tiling(volume::whole({66, 65, 65}), *rows, 0);
}

TEST(Division, SharesOddSizesWithinACell) {
    for (const std::int64_t n : {7, 11, 13, 97, 101, 1009}) {
        for (const int parts : {2, 3, 5}) {
            const auto boxes = divide(volume::whole({3, 3, n}), equal(parts));
            ASSERT_TRUE(boxes);
            expect_tiling(volume::whole({3, 3, n}), *boxes, 2);
            for (const Box& box : *boxes) {
                EXPECT_NEAR(static_cast<double>(box.cells(2)), static_cast<double>(n - 1) / parts, 1.0);
            }
        }
    }
}

TEST(Division, FollowsWeightsAndLeavesNobodyEmpty) {
    const std::vector<double> weights{1, 1000, 1, 1000};
    const auto boxes = divide(volume::whole({12, 3, 3}), weights);
    ASSERT_TRUE(boxes);
    expect_tiling(volume::whole({12, 3, 3}), *boxes, 0);
    EXPECT_EQ((*boxes)[0].cells(0), 1);
    EXPECT_GE((*boxes)[1].cells(0), 4);
}

TEST(Division, TilesForAnyWeights) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> weight(0.01, 10);
    for (int round = 0; round < 200; ++round) {
        std::vector<double> weights(1 + random() % 64);
        std::ranges::generate(weights, [&] { return weight(random); });
        const std::int64_t n =
            static_cast<std::int64_t>(weights.size()) + 1 + static_cast<std::int64_t>(random() % 100);
        const auto boxes = divide(volume::whole({2, n, 2}), weights);
        ASSERT_TRUE(boxes);
        ASSERT_EQ(boxes->size(), weights.size());
        expect_tiling(volume::whole({2, n, 2}), *boxes, 1);
    }
}

TEST(Division, SaysWhenThePlanesRunOut) {
    const auto boxes = divide(volume::whole({4, 4, 4}), equal(4));
    ASSERT_FALSE(boxes);
    EXPECT_EQ(boxes.error().code, base::Code::too_large);
    EXPECT_NE(boxes.error().detail.find("3 cells, too few for 4 parts"), std::string::npos);
}

}  // namespace
}  // namespace shearwater::tree
