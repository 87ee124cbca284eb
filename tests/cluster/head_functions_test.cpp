// Which opacity functions the head asks its renderers for, and when.

#include "server/head/functions.h"

#include <gtest/gtest.h>

namespace shearwater::head {
namespace {

using namespace std::chrono_literals;
using culling::Kind;

constexpr wire::LinkId client{7}, other{8};
const wire::Time begun{};

view::TransferFunction hats(double centre, double height) {
    return {.opacity_pins = {view::Hat{centre, 0.1, 0.2, height}},
            .colour_pins = {{0, {1, 1, 1}}},
            .background = {}};
}

// Everything that is asked for from a moment on at which it has long rested.
wire::pb::WantFunctions wanted(Functions& functions, wire::Time now) {
    functions.take_wanted(now);
    const auto message = functions.take_wanted(now + Functions::rest);
    return message ? std::get<wire::pb::WantFunctions>(message->body) : wire::pb::WantFunctions();
}

wire::FunctionPart part(std::uint64_t number, int place, bool coarse, int first, int directions) {
    return {.number = number,
            .place = place,
            .coarse = coarse,
            .blocks = {{0, 0, 0}, {1, 1, 1}},
            .side = 36,
            .first_direction = first,
            .directions = directions,
            .codes = {}};
}

TEST(HeadFunctions, AreAskedForOnceAViewNeedsThem) {
    Functions functions(2);
    EXPECT_FALSE(functions.take_wanted(begun + 1s));
    EXPECT_FALSE(functions.need(client, hats(0.5, 0.4), Kind::opof, 0).any);
    const auto want = wanted(functions, begun + 2s);
    ASSERT_EQ(want.wants_size(), 2);
    EXPECT_EQ(wire::function_key_from(want.wants(0).key())->footprint, culling::Footprint::block);
    EXPECT_EQ(wire::function_key_from(want.wants(1).key())->footprint, culling::Footprint::column);
    EXPECT_FALSE(functions.take_wanted(begun + 3s)) << "no news";
}

// No function is asked for again where only a height changes.
TEST(HeadFunctions, AreOfAllHeights) {
    Functions functions(1);
    functions.need(client, hats(0.5, 0.4), Kind::opof, 0);
    EXPECT_EQ(wanted(functions, begun + 1s).wants_size(), 2);
    for (const double height : {0.002, 0.1, 0.55, 0.9, 1.0}) {
        functions.need(client, hats(0.5, height), Kind::opof, 0);
        EXPECT_FALSE(functions.take_wanted(begun + 9s)) << height;
    }
}

TEST(HeadFunctions, WaitUntilAShapeRests) {
    Functions functions(1);
    wire::Time now = begun + 1s;
    for (int step = 0; step < 20; ++step, now += 50ms) {
        functions.need(client, hats(0.3 + 0.01 * step, 0.4), Kind::opof, 0);
        EXPECT_FALSE(functions.take_wanted(now)) << step;
    }
    const auto message = functions.take_wanted(now + Functions::rest);
    ASSERT_TRUE(message);
    const auto& want = std::get<wire::pb::WantFunctions>(message->body);
    ASSERT_EQ(want.wants_size(), 2) << "what is no longer looked at is not wanted";
}

TEST(HeadFunctions, OfAllClientsAndLevelsAreWanted) {
    Functions functions(1);
    functions.need(client, hats(0.5, 0.4), Kind::opof, 0);
    functions.need(client, hats(0.5, 0.4), Kind::opof, 1);
    functions.need(other, hats(0.7, 0.4), Kind::pof, 0);
    EXPECT_EQ(wanted(functions, begun + 1s).wants_size(), 2 * 2 + 1);
    functions.forget(other);
    EXPECT_EQ(wanted(functions, begun + 2s).wants_size(), 2 * 2);
}

TEST(HeadFunctions, ThatCameAreKnownByPlace) {
    Functions functions(2);
    functions.need(client, hats(0.5, 0.4), Kind::opof, 0);
    const std::uint64_t number = wanted(functions, begun + 1s).wants(0).number();
    EXPECT_TRUE(functions.came(part(number, 3, true, 0, 648), begun + 2s));
    EXPECT_TRUE(functions.need(client, hats(0.5, 0.4), Kind::opof, 0).any) << "coarse ones do";
    EXPECT_TRUE(functions.came(part(number, 3, false, 0, 400), begun + 2s));
    EXPECT_TRUE(functions.came(part(number, 3, false, 400, 248), begun + 2s));
    EXPECT_FALSE(functions.came(part(number + 2, 3, false, 0, 648), begun + 2s)) << "never asked for";
    functions.need(other, hats(0.1, 0.4), Kind::opof, 0);
    const auto want = wanted(functions, begun + 3s);
    ASSERT_EQ(want.wants_size(), 2 * 2);
    for (const auto& one : want.wants()) {
        EXPECT_EQ(one.known_size(), one.number() == number ? 1 : 0);
    }
}

TEST(HeadFunctions, ThatDoNotComeAreAskedForAgain) {
    Functions functions(1);
    functions.need(client, hats(0.5, 0.4), Kind::pof, 0);
    const auto first = wanted(functions, begun + 1000s);
    EXPECT_FALSE(functions.take_wanted(begun + 1010s));
    const auto again = functions.take_wanted(begun + 1001s + Functions::patience + 1s);
    ASSERT_TRUE(again);
    EXPECT_NE(std::get<wire::pb::WantFunctions>(again->body).renewal(), first.renewal());
    functions.came(part(first.wants(0).number(), 1, false, 0, 648), begun + 1200s);
    EXPECT_FALSE(functions.take_wanted(begun + 9000s)) << "all are there";
}

TEST(HeadFunctions, LongUnusedAreDropped) {
    Functions functions(1);
    for (std::size_t shape = 0; shape < Functions::most_keys + 3; ++shape) {
        functions.need(client, hats(0.01 * static_cast<double>(shape), 0.4), Kind::pof, 0);
    }
    EXPECT_EQ(functions.take_dropped().size(), 3U);
    EXPECT_TRUE(functions.take_dropped().empty());
}

}  // namespace
}  // namespace shearwater::head
