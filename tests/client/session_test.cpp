#include <limits>
#include <random>

#include "tests/client/session_fixture.h"

namespace shearwater::model {
namespace {

TEST_F(SessionTest, DialsAsAClientAndSendsTheViewOnceTheCubeIsKnown) {
    start();
    ASSERT_THAT(dials_, SizeIs(1));
    EXPECT_EQ(dials_[0].role, pb::ROLE_CLIENT);
    EXPECT_EQ(dials_[0].route, (wire::Address{"host", 4000}));
    EXPECT_EQ(status().connection, Connection::connecting);
    want();
    up();
    EXPECT_EQ(status().connection, Connection::connected);
    EXPECT_THAT(views_, IsEmpty());
    receive(description());
    ASSERT_THAT(views_, SizeIs(1));
    EXPECT_EQ(views_[0].revision, 1u);
    EXPECT_EQ(views_[0].camera, camera(wish_.viewpoint, status().cube->lattice));
    EXPECT_EQ(views_[0].size, wish_.size);
    EXPECT_EQ(views_[0].tf, wish_.tf);
    EXPECT_EQ(status().cube->name, "cube.fits");
}

TEST_F(SessionTest, DecodesAcknowledgesAndMeasures) {
    connect();
    want();
    now_ += 40ms;
    auto f = frame(1);
    f.mutable_stats()->set_total_seconds(0.03);
    const auto bytes = code(picture(32, 16));
    receive(f, bytes);
    const auto decoded = session_.take_picture();
    ASSERT_TRUE(decoded);
    const auto expected = picture(32, 16);
    EXPECT_TRUE(std::ranges::equal(decoded->pixels.pixels(), expected.pixels()));
    EXPECT_TRUE(decoded->whole);
    EXPECT_EQ(decoded->quality, view::Quality::normal);
    EXPECT_THAT(shown_, testing::ElementsAre(1));
    EXPECT_NEAR(status().rates.latency_seconds, 0.04, 1e-9);
    EXPECT_NEAR(status().rates.bytes_per_frame, static_cast<double>(bytes.size()), 1e-9);
    EXPECT_NEAR(status().frame->stages.link, 0.01, 1e-9);
    EXPECT_FALSE(session_.take_picture()) << "each picture is given once";
}

TEST_F(SessionTest, CountsFramesPerSecondAndGoesIdle) {
    connect();
    for (int i = 0; i < 20; ++i) {
        turn(Change::dragging);
        now_ += 50ms;
        answer(views_.back().revision);
    }
    EXPECT_NEAR(status().rates.frames_per_second, 20, 0.01);
    now_ += 3s;
    EXPECT_EQ(status().rates.frames_per_second, 0);
    EXPECT_NEAR(status().rates.latency_seconds, 0.05, 1e-9);
}

TEST_F(SessionTest, TheNewestWishWinsWhileTheServerIsBusy) {
    connect();
    for (int i = 0; i < 10; ++i) {
        turn(Change::dragging);
    }
    ASSERT_THAT(views_, SizeIs(2)) << "one under way, one waiting at the server";
    answer(1);
    ASSERT_THAT(views_, SizeIs(3));
    EXPECT_EQ(views_[2].revision, 3u);
    EXPECT_EQ(views_[2].camera, camera(wish_.viewpoint, status().cube->lattice));
    // A server that answers slowly hears of new wishes all the same, at a measured pace.
    for (int i = 0; i < 100; ++i) {
        now_ += 10ms;
        turn(Change::dragging);
    }
    EXPECT_GT(views_.size(), 3u + 20);
    EXPECT_LT(views_.size(), 3u + 27);
}

TEST_F(SessionTest, UnansweredViewsAreBounded) {
    connect();
    for (int i = 0; i < 2000; ++i) {
        now_ += 50ms;
        turn(Change::dragging);
    }
    EXPECT_THAT(views_, SizeIs(Session::most_unanswered));
    answer(views_.back().revision);
    EXPECT_THAT(views_, SizeIs(Session::most_unanswered + 1));
    EXPECT_EQ(views_.back().camera, camera(wish_.viewpoint, status().cube->lattice));
}

TEST_F(SessionTest, HowToDrawIsPartOfTheWish) {
    connect();
    want(Change::single);
    EXPECT_EQ(views_.back().classify, view::Classify::post);
    EXPECT_EQ(views_.back().level_of_detail, std::nullopt);
    wish_.classify = view::Classify::pre_integrated;
    wish_.level_of_detail = false;
    want(Change::single);
    EXPECT_EQ(views_.back().classify, view::Classify::pre_integrated);
    EXPECT_EQ(views_.back().level_of_detail, false);
}

TEST_F(SessionTest, TheSameWishAgainSendsNothing) {
    connect();
    want();
    want();
    want(Change::dragging);
    EXPECT_THAT(views_, SizeIs(1));
}

TEST_F(SessionTest, ReconnectsWithGrowingPausesAndKeepsTheWish) {
    connect();
    turn();
    answer(1);
    pass(500ms);  // high
    const std::uint64_t before = views_.back().revision;
    down(pb::REASON_LOST);
    EXPECT_EQ(status().connection, Connection::waiting);
    EXPECT_NEAR(status().retry_in, 0.25, 1e-9);
    EXPECT_TRUE(status().frame) << "what was seen stays";

    std::vector<double> pauses;
    for (int i = 0; i < 7; ++i) {
        const auto from = now_;
        const auto dials = dials_.size();
        while (dials_.size() == dials) {
            pass(50ms);
        }
        pauses.push_back(std::chrono::duration<double>(now_ - from).count());
        down(pb::REASON_UNREACHABLE);
        EXPECT_THAT(status().words, HasSubstr("No server answers at host:4000"));
    }
    EXPECT_THAT(pauses, testing::Pointwise(testing::DoubleNear(1e-9), {0.25, 0.5, 1.0, 2.0, 4.0, 5.0, 5.0}));

    pass(5s);
    EXPECT_NE(dials_.back().link, dials_.front().link);
    views_.clear();
    up();
    receive(description());
    ASSERT_THAT(views_, SizeIs(1));
    EXPECT_EQ(views_[0].revision, before + 1) << "revisions go on";
    EXPECT_EQ(views_[0].camera, camera(wish_.viewpoint, status().cube->lattice));
    answer(views_[0].revision);
    EXPECT_TRUE(session_.take_picture());
    down(pb::REASON_LOST);
    EXPECT_NEAR(status().retry_in, 0.25, 1e-9) << "a picture shows that all is well again";
}

TEST_F(SessionTest, AWrongSecretIsSaidAndNotTriedAgain) {
    for (const pb::Reason reason : {pb::REASON_BAD_SECRET, pb::REASON_BAD_VERSION}) {
        session_ = Session(wire::Address{"host", 4000});
        dials_.clear();
        start();
        down(reason);
        EXPECT_EQ(status().connection, Connection::refused);
        pass(60s);
        EXPECT_THAT(dials_, SizeIs(1));
        session_.retry(now_);
        take();
        EXPECT_THAT(dials_, SizeIs(2));
    }
}

TEST_F(SessionTest, RetryDialsAtOnce) {
    connect();
    session_.retry(now_);
    take();
    EXPECT_THAT(dials_, SizeIs(1)) << "nothing to retry while connected";
    down(pb::REASON_SHUTDOWN);
    session_.retry(now_);
    take();
    EXPECT_THAT(dials_, SizeIs(2));
    pass(10s);
    EXPECT_THAT(dials_, SizeIs(2));
}

TEST_F(SessionTest, TellsTheTreeInOrderWithItsProgress) {
    connect();
    auto state = tree({pb::PHASE_LOADING, pb::PHASE_READY});
    state.mutable_nodes(1)->set_fraction(0.5);
    state.mutable_nodes(1)->set_name("bad\x1b[31mname");
    state.mutable_nodes(2)->set_fraction(std::numeric_limits<double>::quiet_NaN());
    receive(state);
    const Tree told = status().tree;
    ASSERT_THAT(told.nodes, SizeIs(3));
    EXPECT_EQ(told.nodes[0].depth, 0);
    EXPECT_EQ(told.nodes[1].depth, 1);
    EXPECT_EQ(told.nodes[1].name, "bad?[31mname");
    EXPECT_EQ(told.nodes[2].fraction, 0);
    EXPECT_FALSE(told.ready);
    EXPECT_NEAR(told.loaded(), (0.75 + 1) / 2, 1e-12);
}

TEST_F(SessionTest, AnIncompletePictureIsAskedForAgainWhenMoreIsReady) {
    connect();
    receive(tree({pb::PHASE_READY, pb::PHASE_VACANT}));
    turn();
    pass(400ms);
    auto f = frame(views_.back().revision);
    auto* missing = f.add_missing();
    missing->set_place(2);
    *missing->mutable_box() = wire::to_wire(volume::Box{{0, 0, 0}, {8, 7, 3}});
    receive(f, code(picture(32, 16)));
    EXPECT_FALSE(session_.take_picture()->whole);
    ASSERT_THAT(status().frame->missing, SizeIs(1));
    EXPECT_EQ(status().frame->missing[0].box, (volume::Box{{0, 0, 0}, {8, 7, 3}}));
    views_.clear();
    receive(tree({pb::PHASE_READY, pb::PHASE_LOADING}));
    pass(5s);
    EXPECT_THAT(views_, IsEmpty());
    receive(tree({pb::PHASE_READY, pb::PHASE_READY}));
    ASSERT_THAT(views_, SizeIs(1));
    EXPECT_EQ(views_[0].quality, view::Quality::high);

    // Lost again while it was drawn, with the tree whole by now: asked for once more, after a while.
    f.set_number(++last_number_);
    f.set_revision(views_[0].revision);
    receive(f, code(picture(32, 16)));
    pass(900ms);
    EXPECT_THAT(views_, SizeIs(1));
    pass(200ms);
    ASSERT_THAT(views_, SizeIs(2));
    answer(views_[1].revision);
    pass(5s);
    EXPECT_THAT(views_, SizeIs(2)) << "whole at last";
}

// What a person has just typed may be wrong: until there has been a link, a dial that comes to nothing is the
// end.
TEST_F(SessionTest, IsRefusedAtOnceWhereItDialsOnlyOnceLinked) {
    session_ = Session(wire::Route({"ssh", "ann@big"}), Redial::once_linked, "ann@big:/x.fits");
    start();
    EXPECT_EQ(status().words, "Connecting to ann@big:/x.fits ...");
    down(pb::REASON_LOST, "ssh: Could not resolve hostname big");
    EXPECT_EQ(status().connection, Connection::refused);
    EXPECT_EQ(status().words, "ssh: Could not resolve hostname big") << "the program's own words";
    pass(10s);
    EXPECT_THAT(dials_, SizeIs(1));

    session_.retry(now_);
    take();
    ASSERT_THAT(dials_, SizeIs(2));
    up();
    EXPECT_EQ(status().words, "Connected to ann@big:/x.fits.");
    down(pb::REASON_LOST, "closed");
    EXPECT_EQ(status().connection, Connection::waiting);
    pass(1s);
    EXPECT_THAT(dials_, SizeIs(3)) << "a link that was lost is dialled again";
}

TEST_F(SessionTest, SaysWhyNoServerAnswers) {
    start();
    down(pb::REASON_UNREACHABLE, "host:4000: Connection refused");
    EXPECT_THAT(status().words, HasSubstr("at host:4000 (Connection refused). Is it running"));
    pass(1s);
    down(pb::REASON_TIMED_OUT, "the handshake took too long");
    EXPECT_THAT(status().words, HasSubstr("not as a Shearwater server"));
    pass(1s);
    down(pb::REASON_BAD_SECRET);
    EXPECT_EQ(status().connection, Connection::refused);
    EXPECT_THAT(status().words, HasSubstr("secret is not the one that host:4000 has"));
}

// They are asked for again of a server that was started anew, but not of one that has another cube.
TEST_F(SessionTest, LimitsAreOfTheCubeTheyWereChosenFor) {
    connect();
    wish_.scaling = volume::Scaling{-1, 4, volume::Stretch::log};
    turn();
    ASSERT_FALSE(views_.empty());
    EXPECT_EQ(views_.back().scaling, wish_.scaling);
    answer(views_.back().revision);
    down(pb::REASON_LOST);
    pass(1s);
    connect();
    pass(1s);
    EXPECT_EQ(views_.back().scaling, wish_.scaling);
    down(pb::REASON_LOST);
    pass(1s);
    views_.clear();
    up();
    auto other = description();
    other.set_name("other.fits");
    receive(other);
    pass(1s);
    ASSERT_FALSE(views_.empty());
    EXPECT_FALSE(views_.back().scaling);
}

}  // namespace
}  // namespace shearwater::model
