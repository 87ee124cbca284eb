// What renderers are given so that they can look at parts of pictures, and what comes of it, event by event.

#include "server/head/sharing.h"

#include <gtest/gtest.h>

#include <array>

namespace shearwater::head {
namespace {

using namespace std::chrono_literals;
using Numbers = std::vector<std::uint64_t>;

const wire::Time given_at = wire::Time{} + 1000s;
constexpr int every_direction = 648;

// Gives what is next in pieces of so many directions, to renderers that take all. Its number, or 0.
std::uint64_t give_one(Sharing& sharing, wire::Time now, int at_once = 400) {
    std::uint64_t number = 0;
    for (int first = 0; first < every_direction; first += at_once) {
        const auto piece = sharing.take_piece(now);
        if (!piece) {
            return 0;
        }
        EXPECT_TRUE(number == 0 || number == piece->number);
        number = piece->number;
        EXPECT_EQ(piece->first_direction, first);
        sharing.sent(piece->request, std::min(at_once, every_direction - first), every_direction, now);
        EXPECT_FALSE(sharing.take_piece(now)) << "one at a time";
        EXPECT_FALSE(sharing.replied({piece->request}, now));
    }
    return number;
}

TEST(Sharing, GivesWhatIsNeededPieceByPiece) {
    Sharing sharing;
    EXPECT_TRUE(sharing.given({}));
    EXPECT_FALSE(sharing.take_piece(given_at));
    EXPECT_FALSE(sharing.given(Numbers{4, 7}));
    EXPECT_FALSE(sharing.given(Numbers{4, 7, 9})) << "asked for again, and more";
    EXPECT_EQ(give_one(sharing, given_at), 4U);
    EXPECT_TRUE(sharing.given(Numbers{4}));
    EXPECT_FALSE(sharing.given(Numbers{4, 7}));
    EXPECT_EQ(give_one(sharing, given_at), 7U);
    EXPECT_EQ(give_one(sharing, given_at), 9U);
    EXPECT_TRUE(sharing.given(Numbers{4, 7, 9}));
    EXPECT_FALSE(sharing.take_piece(given_at));
}

TEST(Sharing, GivesOnceMoreWhatSomebodyCouldNotTake) {
    Sharing sharing;
    sharing.given(Numbers{4});
    const auto first = sharing.take_piece(given_at);
    sharing.sent(first->request, 400, every_direction, given_at);
    sharing.replied({first->request, true}, given_at);
    EXPECT_FALSE(sharing.given(Numbers{4}));
    EXPECT_FALSE(sharing.take_piece(given_at + Sharing::pause - 1ms));
    EXPECT_EQ(give_one(sharing, given_at + Sharing::pause), 4U) << "from the first piece on";
}

TEST(Sharing, GoesOnWithoutATableThatIsGone) {
    Sharing sharing;
    sharing.given(Numbers{4, 5});
    const auto piece = sharing.take_piece(given_at);
    sharing.sent(piece->request, 0, 0, given_at);
    EXPECT_EQ(give_one(sharing, given_at + Sharing::pause), 5U);
    EXPECT_FALSE(sharing.given(Numbers{4}));
}

TEST(Sharing, KeepsWhatIsWanted) {
    Sharing sharing;
    sharing.given(Numbers{4, 5, 6, 7});
    give_one(sharing, given_at);
    give_one(sharing, given_at);
    const auto under_way = sharing.take_piece(given_at);
    ASSERT_EQ(under_way->number, 6U);
    sharing.sent(under_way->request, every_direction, every_direction, given_at);
    sharing.keep(Numbers{5});
    sharing.replied({under_way->request}, given_at);
    EXPECT_FALSE(sharing.take_piece(given_at)) << "neither what was under way nor what was to come";
    EXPECT_TRUE(sharing.given(Numbers{5}));
    EXPECT_FALSE(sharing.given(Numbers{4}));
    EXPECT_FALSE(sharing.given(Numbers{6}));
}

TEST(Sharing, TellsLooksFromPieces) {
    Sharing sharing;
    sharing.given(Numbers{4});
    give_one(sharing, given_at);
    sharing.given(Numbers{5});
    const std::uint64_t look = sharing.begin_look(31, {4});
    const auto piece = sharing.take_piece(given_at);
    const std::uint64_t other = sharing.begin_look(32, {4});
    sharing.sent(piece->request, every_direction, every_direction, given_at);
    EXPECT_FALSE(sharing.replied({piece->request}, given_at));
    EXPECT_EQ(sharing.replied({other}, given_at), 32U);
    EXPECT_EQ(sharing.replied({look}, given_at), 31U);
    EXPECT_FALSE(sharing.replied({look}, given_at)) << "once";
    EXPECT_TRUE(sharing.given(Numbers{4, 5}));
}

// Somebody has come back without what was given before.
TEST(Sharing, GivesAnewWhatALookLacked) {
    Sharing sharing;
    sharing.given(Numbers{4, 5});
    give_one(sharing, given_at);
    give_one(sharing, given_at);
    EXPECT_EQ(sharing.replied({sharing.begin_look(31, {4}), true}, given_at), 31U) << "the frame goes on";
    EXPECT_TRUE(sharing.given(Numbers{5}));
    EXPECT_FALSE(sharing.given(Numbers{4}));
    EXPECT_FALSE(sharing.take_piece(given_at + 1s));
    EXPECT_EQ(give_one(sharing, given_at + Sharing::pause), 4U);
}

}  // namespace
}  // namespace shearwater::head
