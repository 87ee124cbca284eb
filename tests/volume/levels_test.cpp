#include "common/volume/levels.h"

#include <gtest/gtest.h>

namespace shearwater::volume {
namespace {

TEST(Levels, EndWhereMoreThan32NodesAreLeft) {
    EXPECT_EQ(coarsest_level({63, 10, 63}), 0);
    EXPECT_EQ(coarsest_level({10, 64, 2}), 1);
    EXPECT_EQ(coarsest_level({64, 2, 2}), 1);
    EXPECT_EQ(coarsest_level({256, 256, 256}), 3);
    EXPECT_EQ(coarsest_level({2, 2, 1024}), 5);
    EXPECT_EQ(coarsest_level({1 << 20, 2, 2}), max_level);
    for (std::int64_t n = 64; n < 1100; ++n) {
        const std::int64_t nodes = last_nodes({n, 2, 2}, coarsest_level({n, 2, 2}))[0] + 1;
        EXPECT_GT(nodes, 32) << n;
        EXPECT_LE(nodes, 65) << n;
    }
}

TEST(Levels, ForASketchHaveAsManyNodesAs128OnASide) {
    EXPECT_EQ(sketch_level({128, 128, 128}), 0);
    EXPECT_EQ(sketch_level({130, 130, 130}), 1);
    EXPECT_EQ(sketch_level({512, 512, 512}), 2);
    EXPECT_EQ(sketch_level({645, 645, 645}), 3);
    EXPECT_EQ(sketch_level({1024, 1024, 1024}), 3);
    EXPECT_EQ(sketch_level({2048, 2048, 2048}), 4);
    EXPECT_EQ(sketch_level({8193, 8193, 8193}), 5) << "the coarsest";
    EXPECT_EQ(sketch_level({20000, 20000, 20000}), 0) << "more than are read soon";
    EXPECT_EQ(sketch_level({1 << 20, 2, 2}), 0);
    EXPECT_EQ(sketch_level({2, 2, 2}), 0);
}

TEST(Levels, EndAtOrBeyondTheLastVoxel) {
    EXPECT_EQ(last_nodes({65, 66, 2}, 1), (Index3{32, 33, 1}));
    EXPECT_EQ(last_nodes({65, 66, 2}, 5), (Index3{2, 3, 1}));
    EXPECT_EQ(last_nodes({65, 66, 2}, 0), (Index3{64, 65, 1}));
}

TEST(Levels, HoldTheNodesAboutABox) {
    const Box box{{7, 8, 9}, {8, 17, 100}};
    EXPECT_EQ(nodes_of(box, 0), box);
    EXPECT_EQ(nodes_of(box, 3), (Box{{0, 1, 1}, {1, 3, 13}}));
}

TEST(Levels, KeepAMarginOfOneNodeInsideTheCube) {
    const Index3 n{101, 60, 30};
    EXPECT_EQ(nodes_kept({{7, 0, 9}, {8, 17, 29}}, 0, n), (Box{{6, 0, 8}, {9, 18, 29}}));
    EXPECT_EQ(nodes_kept({{7, 0, 9}, {98, 17, 29}}, 1, n), (Box{{2, 0, 3}, {50, 10, 15}}));
    EXPECT_EQ(nodes_kept(whole(n), 0, n), whole(n));
    const Box inner{{64, 64, 64}, {128, 128, 128}};
    EXPECT_EQ(nodes_kept(inner, max_margin_level, {500, 500, 500}), (Box{{15, 15, 15}, {33, 33, 33}}));
    EXPECT_EQ(nodes_kept(inner, max_margin_level + 1, {500, 500, 500}),
              nodes_of(inner, max_margin_level + 1));
}

TEST(Levels, AreMadeFromWhatLiesAboutTheBox) {
    const Index3 n{300, 200, 129};
    for (const Box& box : {whole(n), Box{{0, 0, 0}, {1, 1, 1}}, Box{{150, 100, 64}, {299, 199, 128}},
                           Box{{37, 101, 3}, {38, 155, 127}}}) {
        const auto levels = nodes_to_make(box, n);
        ASSERT_EQ(levels.size(), 4U);
        for (int level = 0; level < 4; ++level) {
            const Box& nodes = levels[static_cast<std::size_t>(level)];
            EXPECT_TRUE(nodes.contains(nodes_kept(box, level, n)));
            EXPECT_TRUE((Box{{0, 0, 0}, last_nodes(n, level)}.contains(nodes)));
            if (level > 0) {
                EXPECT_TRUE(levels[static_cast<std::size_t>(level) - 1].contains(
                    made_from(nodes, last_nodes(n, level - 1))));
            }
        }
    }
    EXPECT_EQ(nodes_to_make(whole(n), n).front(), whole(n));
    EXPECT_EQ(nodes_to_make({{0, 0, 0}, {128, 199, 128}}, n).front().hi, (Index3{135, 199, 128}));
}

}  // namespace
}  // namespace shearwater::volume
