#include "common/tree/plan.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shearwater::tree {
namespace {

TEST(FullTree, HasThePapersNumbersOfNodes) {
    for (const auto& [b, n] : {std::pair{2, 2}, {2, 3}, {2, 5}, {3, 3}, {8, 2}, {64, 2}, {1, 2}}) {
        const auto topology = full_tree(b, n);
        ASSERT_TRUE(topology);
        int compositors = 0;
        for (int level = 0; level < n - 1; ++level) {
            compositors += static_cast<int>(std::pow(b, level));
        }
        EXPECT_EQ(topology->renderers(), static_cast<int>(std::pow(b, n - 1)));
        EXPECT_EQ(static_cast<int>(topology->nodes.size()), topology->renderers() + compositors);
    }
}

TEST(FullTree, RefusesWhatIsNoTree) {
    EXPECT_FALSE(full_tree(0, 3));
    EXPECT_FALSE(full_tree(65, 2));
    EXPECT_FALSE(full_tree(2, 1));
    EXPECT_FALSE(full_tree(-2, 3));
    EXPECT_FALSE(full_tree(64, 4));  // more nodes than are taken
    EXPECT_FALSE(full_tree(2, 1000));
}

// The leaves' boxes fill the cube without overlap, whatever the tree.
TEST(Plan, LeavesTileTheCube) {
    for (const auto& [b, n] : {std::pair{2, 4}, {3, 3}, {5, 2}, {8, 2}}) {
        const volume::Index3 size{31, 37, 29};
        const auto plan = make_plan(*full_tree(b, n), size);
        ASSERT_TRUE(plan);
        const auto leaves = plan->renderers_below(0);
        std::int64_t cells = 0;
        for (const Place leaf : leaves) {
            const volume::Box& box = plan->at(leaf).box;
            cells += box.cells(0) * box.cells(1) * box.cells(2);
            for (const Place other : leaves) {
                if (other == leaf) {
                    continue;
                }
                const volume::Box& with = plan->at(other).box;
                bool apart = false;
                for (int axis = 0; axis < 3; ++axis) {
                    apart = apart || box.hi[axis] <= with.lo[axis] || with.hi[axis] <= box.lo[axis];
                }
                EXPECT_TRUE(apart) << volume::to_string(box) << " and " << volume::to_string(with);
            }
        }
        EXPECT_EQ(cells, 30 * 36 * 28);
    }
}

TEST(Plan, KnowsWhoIsBelowWhom) {
    const auto plan = make_plan(*full_tree(2, 3), {16, 16, 16});
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->renderers_below(0), (std::vector<Place>{3, 4, 5, 6}));
    EXPECT_EQ(plan->renderers_below(1), (std::vector<Place>{3, 4}));
    EXPECT_EQ(plan->renderers_below(6), (std::vector<Place>{6}));
}

TEST(Plan, NamesTheBoxWhosePlanesRanOut) {
    const auto plan = make_plan(*full_tree(8, 3), {5, 20, 5});
    ASSERT_FALSE(plan);
    EXPECT_EQ(plan.error().code, base::Code::too_large);
    EXPECT_NE(plan.error().operation.find("divide ["), std::string::npos);
}

}  // namespace
}  // namespace shearwater::tree
