// Pairs of pictures and crops, asked for and taken.

#include "tests/client/session_fixture.h"

namespace shearwater::model {
namespace {

using volume::Box;

class SessionStereoTest : public SessionTest {
  protected:
    pb::Frame pair(std::uint64_t revision) {
        pb::Frame f = frame(revision);
        f.set_eyes(2);
        return f;
    }
};

TEST_F(SessionStereoTest, AsksForAPairAndTakesItWhole) {
    wish_.stereo = view::StereoSettings{0.5, 0, true};
    connect();
    want();
    ASSERT_THAT(views_, SizeIs(1));
    EXPECT_EQ(views_[0].stereo, wish_.stereo);
    const auto both = picture(32, 2 * 16);
    receive(pair(1), code(both));
    const auto taken = session_.take_picture();
    ASSERT_TRUE(taken);
    ASSERT_EQ(taken->pixels.height(), 16);
    ASSERT_EQ(taken->right.height(), 16);
    EXPECT_EQ(taken->pixels.at(5, 15), both.at(5, 15));
    EXPECT_EQ(taken->right.at(5, 0), both.at(5, 16));
    EXPECT_THAT(closes_, IsEmpty());
    EXPECT_THAT(shown_, testing::ElementsAre(1));
}

TEST_F(SessionStereoTest, TakesOneWhereOneWasAskedFor) {
    connect();
    want();
    answer(1);
    const auto taken = session_.take_picture();
    ASSERT_TRUE(taken);
    EXPECT_TRUE(taken->right.empty());
}

TEST_F(SessionStereoTest, RefusesAnEyeTooMany) {
    connect();
    want();
    receive(pair(1), code(picture(32, 32)));
    expect_closed(pb::REASON_INVALID, "eyes");
}

TEST_F(SessionStereoTest, RefusesAnEyeTooFew) {
    wish_.stereo = view::StereoSettings();
    connect();
    want();
    receive(frame(1), code(picture(32, 16)));
    expect_closed(pb::REASON_INVALID, "eyes");
}

TEST_F(SessionStereoTest, RefusesAPairCutShort) {
    wish_.stereo = view::StereoSettings();
    connect();
    want();
    receive(pair(1), code(picture(32, 31)));
    expect_closed(pb::REASON_MALFORMED, "frame");
}

// What a server would end the link for is not sent.
TEST_F(SessionStereoTest, LeavesOutWhatNoServerWouldTake) {
    wish_.stereo = view::StereoSettings{1e9, 1, false};
    wish_.crop = Box{{0, 0, 0}, {100, 3, 3}};  // of another cube
    connect();
    want();
    ASSERT_THAT(views_, SizeIs(1));
    EXPECT_FALSE(views_[0].stereo);
    EXPECT_FALSE(views_[0].crop);
    answer(1);
    EXPECT_TRUE(session_.take_picture());
}

TEST_F(SessionStereoTest, AsksForACrop) {
    wish_.crop = Box{{1, 2, 0}, {8, 7, 3}};
    connect();
    want();
    ASSERT_THAT(views_, SizeIs(1));
    EXPECT_EQ(views_[0].crop, wish_.crop);
    wish_.crop.reset();
    answer(1);
    want();
    ASSERT_THAT(views_, SizeIs(2));
    EXPECT_FALSE(views_[1].crop);
}

}  // namespace
}  // namespace shearwater::model
