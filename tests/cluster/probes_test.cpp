// The bookkeeping of rays at a node with children, event by event.

#include "protocol/node/probes.h"

#include <gtest/gtest.h>

namespace shearwater::node {
namespace {

using namespace std::chrono_literals;

const wire::Time asked_at{};

view::Factorisation ray(int sign) {
    view::Factorisation made;
    made.slice_exponent = -1;
    made.faces = {{.axis = 0, .sign = sign, .width = 1, .height = 1, .origin = {}, .pitch = {1, 1}}};
    return made;
}

TEST(Probes, PutPartsInVisibilityOrder) {
    for (const int sign : {1, -1}) {
        Probes probes;
        probes.begin(5, ray(sign), {0, 1, 2}, false, asked_at);
        probes.answer(1, {5,
                          sign > 0 ? std::vector<view::RaySample>{{7, 1}, {9, 2}}
                                   : std::vector<view::RaySample>{{9, 2}, {7, 1}},
                          false});
        EXPECT_TRUE(probes.take_complete().empty());
        probes.answer(0, {5, {}, false});
        probes.answer(2, {5, {{2, 3}}, false});
        const auto complete = probes.take_complete();
        ASSERT_EQ(complete.size(), 1U);
        std::vector<view::RaySample> expected{{2, 3}, {7, 1}, {9, 2}};
        if (sign < 0) {
            std::ranges::reverse(expected);
        }
        EXPECT_EQ(complete[0].samples, expected);
        EXPECT_FALSE(complete[0].incomplete);
        EXPECT_EQ(probes.pending(), 0U);
    }
}

// Whatever children say, what goes on is in order: a parent takes nothing else.
TEST(Probes, ASliceClaimedTwiceIsTakenOnce) {
    Probes probes;
    probes.begin(5, ray(1), {0, 1}, false, asked_at);
    probes.answer(0, {5, {{9, 1}, {2, 3}}, false});
    probes.answer(1, {5, {{2, 4}, {9, 2}, {11, 1}}, false});
    const auto complete = probes.take_complete();
    ASSERT_EQ(complete.size(), 1U);
    EXPECT_EQ(complete[0].samples.size(), 3U);
    EXPECT_TRUE(wire::ray_part_from(wire::to_wire(complete[0])));
}

TEST(Probes, GoOnWithoutAChildThatIsGoneOrSilent) {
    Probes probes;
    probes.begin(5, ray(1), {0, 1}, false, asked_at);
    probes.begin(6, ray(1), {1}, false, asked_at);
    probes.answer(1, {5, {{2, 4}}, false});
    probes.child_gone(0);
    auto complete = probes.take_complete();
    ASSERT_EQ(complete.size(), 1U);
    EXPECT_EQ(complete[0].number, 5U);
    EXPECT_TRUE(complete[0].incomplete);
    EXPECT_EQ(complete[0].samples.size(), 1U);

    probes.tick(asked_at + Probes::patience);
    EXPECT_TRUE(probes.take_complete().empty());
    probes.tick(asked_at + Probes::patience + 1ms);
    complete = probes.take_complete();
    ASSERT_EQ(complete.size(), 1U);
    EXPECT_EQ(complete[0].number, 6U);
    EXPECT_TRUE(complete[0].incomplete);
    probes.answer(1, {6, {{2, 4}}, false});  // too late
    EXPECT_TRUE(probes.take_complete().empty());
}

TEST(Probes, WithNobodyToAskAreAnsweredAtOnce) {
    Probes probes;
    probes.begin(5, ray(1), {}, true, asked_at);
    const auto complete = probes.take_complete();
    ASSERT_EQ(complete.size(), 1U);
    EXPECT_TRUE(complete[0].incomplete);
}

TEST(Probes, AreBounded) {
    Probes probes;
    for (std::uint64_t number = 1; number <= 2 * Probes::most_pending; ++number) {
        probes.begin(number, ray(1), {0}, false, asked_at);
        EXPECT_LE(probes.pending(), Probes::most_pending);
    }
    const auto complete = probes.take_complete();
    ASSERT_EQ(complete.size(), Probes::most_pending);
    EXPECT_EQ(complete[0].number, 1U);
    EXPECT_TRUE(complete[0].incomplete);
    probes.forget_all();
    EXPECT_EQ(probes.pending(), 0U);
}

}  // namespace
}  // namespace shearwater::node
