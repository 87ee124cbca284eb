// What a session asks about a point of the picture, and what it makes of the answers.

#include "protocol/wire/convert_pick.h"
#include "tests/client/session_fixture.h"

namespace shearwater::model {
namespace {

class SessionPickTest : public SessionTest {
  protected:
    void pick(Purpose purpose = Purpose::read, const view::Vec2& at = {3.5, 4.5}) {
        session_.pick(purpose, at);
        take();
    }
    wire::PickRequest asked(std::size_t n) const {
        auto parsed = wire::pick_from(picks_.at(n));
        EXPECT_TRUE(parsed) << parsed.error().text;
        return *parsed;
    }
    void answer(std::uint64_t revision, const view::Vec3& voxel = {1, 2, 3}) {
        receive(wire::to_wire(
            wire::PickAnswer{.revision = revision, .hit = view::RayHit{voxel, 0.5}, .value = 7}));
    }
};

TEST_F(SessionPickTest, AsksOfTheViewThatIsWanted) {
    connect();
    want();
    turn();
    pick(Purpose::pivot);
    ASSERT_THAT(picks_, SizeIs(1));
    EXPECT_EQ(asked(0).camera, camera(wish_.viewpoint, status().cube->lattice));
    EXPECT_EQ(asked(0).size, wish_.size);
    EXPECT_EQ(asked(0).tf, wish_.tf);
    answer(asked(0).revision);
    const auto picked = session_.take_picked();
    ASSERT_TRUE(picked && picked->hit);
    EXPECT_EQ(picked->purpose, Purpose::pivot);
    EXPECT_EQ(picked->at, (view::Vec2{3.5, 4.5}));
    EXPECT_EQ(picked->hit->voxel, (view::Vec3{1, 2, 3}));
    EXPECT_EQ(picked->value, 7);
    EXPECT_FALSE(session_.take_picked());
}

TEST_F(SessionPickTest, AsksNothingWithoutALinkACubeOrAPlaceInThePicture) {
    start();
    want();
    pick();
    up();
    pick();
    receive(description());
    pick(Purpose::read, {33, 4});
    pick(Purpose::read, {-1, 4});
    EXPECT_THAT(picks_, IsEmpty());
    pick();
    EXPECT_THAT(picks_, SizeIs(1));
}

TEST_F(SessionPickTest, OnlyTheNewestAnswerCounts) {
    connect();
    want();
    pick();
    pick(Purpose::pivot, {5, 6});
    answer(asked(0).revision);
    EXPECT_FALSE(session_.take_picked());
    answer(asked(1).revision);
    EXPECT_EQ(session_.take_picked()->at, (view::Vec2{5, 6}));
    answer(asked(1).revision);
    EXPECT_FALSE(session_.take_picked()) << "answered twice";
    EXPECT_THAT(closes_, IsEmpty());
}

TEST_F(SessionPickTest, AnAnswerToNothingEndsTheLink) {
    connect();
    want();
    pick();
    answer(asked(0).revision + 1);
    expect_closed(pb::REASON_INVALID, "not asked for");
}

TEST_F(SessionPickTest, AnAnswerOutsideTheCubeEndsTheLink) {
    connect();
    want();
    pick();
    answer(asked(0).revision, {9, 0, 0});
    expect_closed(pb::REASON_INVALID, "outside the cube");
}

// A picture is kept in a file with what it is of, not with what is wanted by then.
TEST_F(SessionPickTest, APictureKnowsWhatItIsOf) {
    connect();
    want();
    const Wish first = wish_;
    turn();
    SessionTest::answer(1);
    EXPECT_EQ(session_.picture_wish(), first);
    SessionTest::answer(2);
    EXPECT_EQ(session_.picture_wish(), wish_);
}

}  // namespace
}  // namespace shearwater::model
