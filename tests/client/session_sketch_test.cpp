// Pictures of a sketch, while the cube is loading.

#include "tests/client/session_fixture.h"

namespace shearwater::model {
namespace {

class SessionSketchTest : public SessionTest {
  protected:
    static pb::CubeDescription provisional() {
        pb::CubeDescription d = description();
        d.set_provisional(true);
        d.mutable_mapping()->set_hi(0.75);
        return d;
    }
    static pb::TreeState counting(double fraction) {
        pb::TreeState state = tree({pb::PHASE_COUNTING, pb::PHASE_COUNTING});
        for (pb::Node& node : *state.mutable_nodes()) {
            node.set_fraction(fraction);
        }
        return state;
    }
    void answer_by_sketch(std::uint64_t revision) {
        pb::Frame f = frame(revision);
        f.set_sketch(true);
        receive(f, code(picture(32, 16)));
    }
    // Connected to a server that is loading, with a first look at what is wanted.
    void look() {
        start();
        up();
        want();
        receive(counting(0.5));
        receive(provisional());
        ASSERT_THAT(views_, SizeIs(1));
        answer_by_sketch(1);
        ASSERT_TRUE(session_.take_picture());
    }
};

TEST_F(SessionSketchTest, AreWelcome) {
    look();
    EXPECT_TRUE(views_[0].sketch);
    EXPECT_FALSE(views_[0].level_of_detail) << "as the server has it";
}

TEST_F(SessionSketchTest, AreSaidToBeAFirstLook) {
    start();
    up();
    EXPECT_EQ(status().first_look(), "") << "there is no picture yet";
    want();
    receive(provisional());
    EXPECT_TRUE(status().cube->provisional);
    receive(counting(0.86));
    answer_by_sketch(1);
    EXPECT_EQ(status().first_look(), "first look, 43 % loaded");
    receive(tree({pb::PHASE_LOADING, pb::PHASE_READY}));
    EXPECT_EQ(status().first_look(), "first look, 75 % loaded");
    receive(tree({pb::PHASE_READY, pb::PHASE_READY}));
    EXPECT_EQ(status().first_look(), "first look, 100 % loaded");
    answer(1);
    EXPECT_EQ(status().first_look(), "");
}

// The cube's picture comes with nothing asked, and is then refined like any other.
TEST_F(SessionSketchTest, AreNotRefinedButFollowedByTheCubes) {
    look();
    pass(5s);
    EXPECT_THAT(views_, SizeIs(1));
    EXPECT_TRUE(status().refining) << "a better one is to come";
    receive(tree({pb::PHASE_READY, pb::PHASE_READY}));
    answer(1);
    EXPECT_TRUE(session_.take_picture());
    EXPECT_THAT(closes_, IsEmpty());
    EXPECT_FALSE(status().frame->sketch);
    pass(1s);
    ASSERT_THAT(views_, SizeIs(2));
    EXPECT_EQ(views_[1].quality, view::Quality::high);
}

TEST_F(SessionSketchTest, FollowTheCamera) {
    look();
    turn(Change::dragging);
    ASSERT_THAT(views_, SizeIs(2));
    answer_by_sketch(2);
    EXPECT_EQ(status().frame->revision, 2u);
    pass(1s);
    ASSERT_THAT(views_, SizeIs(3)) << "from draft to normal, when it rests";
    EXPECT_EQ(views_[2].quality, view::Quality::normal);
    answer_by_sketch(3);
    pass(1s);
    EXPECT_THAT(views_, SizeIs(3));
}

// Its own limits change how values are shown, not where the eye is.
TEST_F(SessionSketchTest, TheCubesLimitsAskForNothing) {
    look();
    receive(description());
    EXPECT_FALSE(status().cube->provisional);
    EXPECT_EQ(status().cube->mapping.hi, 1);
    EXPECT_THAT(views_, SizeIs(1));
    pb::CubeDescription another = description();
    *another.mutable_lattice() = wire::to_wire(view::Lattice{.n = {9, 8, 70}, .spacing = {1, 1, 1}});
    receive(another);
    EXPECT_THAT(views_, SizeIs(2)) << "another cube does";
}

// Waiting for the cube is no latency, and says nothing of what a quality costs.
TEST_F(SessionSketchTest, CountForNoRate) {
    look();
    now_ += 10s;
    answer(1);
    EXPECT_EQ(status().rates.latency_seconds, 0);
}

// With what is known of the values at the time; that more is known is no other cube.
TEST_F(SessionSketchTest, TellsWhatIsKnownOfTheValues) {
    look();
    EXPECT_EQ(status().cube->values, nullptr);
    volume::Histogram histogram;
    for (int i = 0; i < 100; ++i) {
        histogram.add(static_cast<float>(i) / 100);
    }
    const volume::Summary first = volume::summarise(histogram, {.lo = 0, .hi = 0.75});
    pb::CubeDescription described = provisional();
    *described.mutable_values() = wire::to_wire(first);
    described.mutable_values()->set_provisional(true);
    receive(described);
    ASSERT_NE(status().cube->values, nullptr);
    EXPECT_EQ(*status().cube->values, first);
    EXPECT_TRUE(status().cube->provisional_values);
    EXPECT_TRUE(status().cube->scale().has(view::Unit::sigma));
    histogram.add(3);
    described = description();
    *described.mutable_values() = wire::to_wire(volume::summarise(histogram, {}));
    receive(described);
    EXPECT_EQ(status().cube->values->max, 3);
    EXPECT_FALSE(status().cube->provisional_values);
    EXPECT_THAT(views_, SizeIs(1)) << "nothing is asked for again";
}

}  // namespace
}  // namespace shearwater::model
