// Which functions a renderer has been given: whole ones, in order, and no more than it keeps.

#include "renderer/leaf/given_functions.h"

#include <gtest/gtest.h>

namespace shearwater::leaf {
namespace {

using Numbers = std::vector<std::uint64_t>;

wire::GivenFunctions piece(std::uint64_t number, double centre, int first, int directions) {
    return {.request = 1,
            .key = {culling::Footprint::column, {view::Hat{centre, 0.1, 0.2, 1}, {}}, 0},
            .part = {.number = number,
                     .place = 0,
                     .coarse = false,
                     .blocks = {{0, 0, 0}, {1, 1, 1}},
                     .side = 4,
                     .first_direction = first,
                     .directions = directions,
                     .codes = {}}};
}

TEST(GivenFunctions, AreThereOnceAllPiecesAre) {
    GivenFunctions given;
    EXPECT_TRUE(given.has({}));
    EXPECT_FALSE(given.has(Numbers{3}));
    EXPECT_TRUE(given.take(piece(3, 0.5, 0, 5)));
    EXPECT_FALSE(given.has(Numbers{3}));
    EXPECT_TRUE(given.take(piece(3, 0.5, 5, 3)));
    EXPECT_TRUE(given.has(Numbers{3}));
    EXPECT_FALSE(given.has(Numbers{3, 4}));
}

TEST(GivenFunctions, WithAPieceMissingAreNotTaken) {
    GivenFunctions given;
    EXPECT_FALSE(given.take(piece(3, 0.5, 5, 3))) << "the first";
    EXPECT_TRUE(given.take(piece(3, 0.5, 0, 2)));
    EXPECT_FALSE(given.take(piece(3, 0.5, 5, 3)));
    EXPECT_FALSE(given.take(piece(3, 0.7, 2, 6))) << "of another key";
    EXPECT_FALSE(given.has(Numbers{3}));
    EXPECT_TRUE(given.take(piece(3, 0.5, 0, 8))) << "from the first on";
    EXPECT_TRUE(given.has(Numbers{3}));
}

// A key's newest are those that looks go by: of an older number there is nothing left.
TEST(GivenFunctions, TakeThePlaceOfTheKeysOlderOnes) {
    GivenFunctions given;
    given.take(piece(3, 0.5, 0, 8));
    given.take(piece(9, 0.5, 0, 8));
    EXPECT_TRUE(given.has(Numbers{9}));
    EXPECT_FALSE(given.has(Numbers{3}));
}

TEST(GivenFunctions, ThatAreNotKeptAreGone) {
    GivenFunctions given;
    for (std::uint64_t number = 1; number <= 3; ++number) {
        given.take(piece(number, 0.1 * static_cast<double>(number), 0, 8));
    }
    const auto dropped = given.keep(Numbers{2, 8});
    ASSERT_EQ(dropped.size(), 2U);
    EXPECT_EQ(dropped[0], piece(1, 0.1, 0, 8).key);
    EXPECT_TRUE(given.has(Numbers{2}));
    EXPECT_FALSE(given.has(Numbers{1}));
}

TEST(GivenFunctions, AreBounded) {
    GivenFunctions given;
    for (std::uint64_t number = 1; number <= GivenFunctions::most; ++number) {
        EXPECT_TRUE(given.take(piece(number, 0.001 * static_cast<double>(number), 0, 8)));
    }
    EXPECT_FALSE(given.take(piece(1000, 0.9, 0, 8)));
    EXPECT_TRUE(given.take(piece(1001, 0.001, 0, 8))) << "in the place of another";
}

}  // namespace
}  // namespace shearwater::leaf
