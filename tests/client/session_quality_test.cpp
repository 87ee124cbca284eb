// Which quality a session asks for, and when it asks for nothing.

#include "tests/client/session_fixture.h"

namespace shearwater::model {
namespace {

using view::Quality;

class SessionQualityTest : public SessionTest {
  protected:
    // The server answers the newest view after as long as its quality takes, rendering all the while.
    void answer_newest() {
        constexpr std::chrono::milliseconds times[] = {10ms, 40ms, 200ms};
        const wire::View asked = views_.back();
        const auto time = times[static_cast<int>(asked.quality)] * slowness_;
        now_ += time;
        auto f = frame(asked.revision);
        f.mutable_stats()->mutable_leaves()->set_render_seconds(std::chrono::duration<double>(time).count());
        receive(f, code(picture(32, 16)));
    }
    void drag(std::chrono::milliseconds time) {
        const wire::Time end = now_ + time;
        while (now_ < end) {
            turn(Change::dragging);
            answer_newest();
        }
    }
    Quality asked() const { return views_.back().quality; }
    Quality seen() {
        const auto shown = session_.take_picture();
        EXPECT_TRUE(shown);
        return shown->quality;
    }

    int slowness_ = 1;
};

TEST_F(SessionQualityTest, DraftWhileMovingThenNormalThenHighThenSilence) {
    connect();
    turn(Change::dragging);
    EXPECT_EQ(asked(), Quality::draft) << "nothing is known yet";
    answer(1);
    EXPECT_EQ(seen(), Quality::draft);
    pass(150ms);
    EXPECT_THAT(views_, SizeIs(1));
    EXPECT_FALSE(status().refining);
    pass(50ms);
    ASSERT_THAT(views_, SizeIs(2));
    EXPECT_EQ(asked(), Quality::normal);
    EXPECT_TRUE(status().refining);
    pass(10s);
    EXPECT_THAT(views_, SizeIs(2)) << "high before normal has come";
    answer(2);
    EXPECT_EQ(seen(), Quality::normal);
    ASSERT_THAT(views_, SizeIs(3));
    EXPECT_EQ(asked(), Quality::high);
    EXPECT_TRUE(status().refining);
    answer(3);
    EXPECT_EQ(seen(), Quality::high);
    EXPECT_FALSE(status().refining);
    pass(60s);
    want();
    EXPECT_THAT(views_, SizeIs(3)) << "the best is seen";
}

TEST_F(SessionQualityTest, HoldsTheRateByDraftsOfASlowServer) {
    connect();
    slowness_ = 4;
    drag(3s);
    views_.clear();
    drag(3s);
    EXPECT_GE(views_.size(), 20u * 3);
    for (const wire::View& view : views_) {
        EXPECT_EQ(view.quality, Quality::draft);
    }
}

TEST_F(SessionQualityTest, MovesInNormalQualityWhereThatIsFastEnough) {
    connect();
    drag(1s);
    views_.clear();
    drag(3s);
    EXPECT_GE(views_.size(), 20u * 3);
    for (const wire::View& view : views_) {
        EXPECT_EQ(view.quality, Quality::normal);
    }
    // What is seen is normal already, so high is next.
    pass(200ms);
    EXPECT_EQ(asked(), Quality::high);
    views_.clear();
    session_.set_effort({.fixed = {}, .target_rate = 60}, now_);
    take();
    drag(1s);
    EXPECT_EQ(asked(), Quality::draft);
}

TEST_F(SessionQualityTest, IsRefinedWithinASecondOfRest) {
    connect();
    slowness_ = 2;
    drag(2s);
    ASSERT_EQ(asked(), Quality::draft);
    const wire::Time from = now_;
    while (status().frame->quality != Quality::high) {
        ASSERT_LT(now_ - from, 1s);
        const auto before = views_.size();
        pass(50ms);
        while (views_.size() > before && status().frame->revision != views_.back().revision) {
            answer_newest();
        }
    }
    EXPECT_LE(now_ - from, 1s);
}

TEST_F(SessionQualityTest, ARefinementIsGivenUpOnceTheViewMoves) {
    connect();
    slowness_ = 10;
    drag(1s);
    pass(200ms);
    ASSERT_EQ(asked(), Quality::normal);
    const auto given_up = views_.back().revision;
    turn(Change::dragging);
    ASSERT_EQ(views_.back().revision, given_up + 1) << "the newest view does not wait";
    EXPECT_EQ(asked(), Quality::draft);
    EXPECT_FALSE(status().refining);
    answer_newest();
    answer(given_up);
    EXPECT_EQ(status().frame->revision, given_up + 1);
    EXPECT_EQ(asked(), Quality::draft);
    pass(50ms);
    EXPECT_EQ(asked(), Quality::draft) << "no rest yet";
    pass(50ms);
    EXPECT_EQ(asked(), Quality::normal);
    answer_newest();
    ASSERT_EQ(asked(), Quality::high);
    turn(Change::dragging);
    EXPECT_EQ(asked(), Quality::draft);
}

TEST_F(SessionQualityTest, ASingleChangeIsNotMadeADraftUnlessManyFollow) {
    connect();
    slowness_ = 4;
    turn(Change::single);
    EXPECT_EQ(asked(), Quality::normal);
    answer_newest();
    for (int i = 0; i < 5; ++i) {  // a key held down
        now_ += 30ms;
        turn(Change::single);
        EXPECT_EQ(asked(), Quality::draft) << i;
        answer_newest();
    }
}

TEST_F(SessionQualityTest, AFixedQualityIsUsedAlways) {
    for (const Quality fixed : {Quality::draft, Quality::normal, Quality::high}) {
        session_ = Session(wire::Address{"host", 4000});
        views_.clear();
        wish_.viewpoint = {};
        session_.set_effort({.fixed = fixed}, now_);
        connect();
        want();
        answer_newest();
        drag(1s);
        turn(Change::single);
        answer_newest();
        const auto sent = views_.size();
        pass(10s);
        EXPECT_THAT(views_, SizeIs(sent)) << "nothing to refine";
        EXPECT_FALSE(status().refining);
        for (const wire::View& view : views_) {
            EXPECT_EQ(view.quality, fixed);
        }
    }
}

TEST_F(SessionQualityTest, FixingAndFreeingTheQualityAsksForWhatIsNotYetSeen) {
    connect();
    want();
    const auto set = [&](std::optional<Quality> fixed, double rate = 20) {
        session_.set_effort({.fixed = fixed, .target_rate = rate}, now_);
        take();
    };
    answer_newest();
    pass(200ms);
    answer_newest();
    ASSERT_EQ(status().frame->quality, Quality::high);
    views_.clear();
    set({}, 30);
    set(Quality::high);
    set({});
    EXPECT_THAT(views_, IsEmpty());
    set(Quality::draft);
    ASSERT_THAT(views_, SizeIs(1));
    EXPECT_EQ(asked(), Quality::draft);
    answer_newest();
    pass(5s);
    EXPECT_THAT(views_, SizeIs(1));
    set({});
    EXPECT_EQ(asked(), Quality::normal);
    answer_newest();
    EXPECT_EQ(asked(), Quality::high);
    answer_newest();
    pass(5s);
    EXPECT_THAT(views_, SizeIs(3));
}

TEST_F(SessionQualityTest, ANewLinkBeginsWithANormalPicture) {
    connect();
    drag(1s);
    down(pb::REASON_LOST);
    pass(1s);
    EXPECT_FALSE(status().refining);
    views_.clear();
    up();
    pass(1s);
    EXPECT_THAT(views_, IsEmpty());
    receive(description());
    ASSERT_THAT(views_, SizeIs(1));
    EXPECT_EQ(asked(), Quality::normal);
    answer_newest();
    EXPECT_EQ(asked(), Quality::high);
    answer_newest();
    pass(10s);
    EXPECT_THAT(views_, SizeIs(2));
}

}  // namespace
}  // namespace shearwater::model
