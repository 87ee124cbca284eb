// Key frames as a person sets, moves and plays them.

#include "client/model/timeline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace shearwater::model {
namespace {

using namespace std::chrono_literals;

const view::Lattice filmed_lattice{.n = {40, 50, 60}};

view::Viewpoint from(double azimuth) {
    view::Viewpoint viewpoint;
    viewpoint.orbit.azimuth = azimuth;
    viewpoint.orbit.distance = 100;
    return viewpoint;
}

// Keys at 0, 1 and 3 seconds, from 0, 40 and 60 degrees.
Timeline three() {
    Timeline timeline;
    for (const auto& [time, azimuth] : {std::pair{0.0, 0.0}, {1.0, 40.0}, {3.0, 60.0}}) {
        timeline.seek(time);
        timeline.keep({from(azimuth), view::default_transfer_function(), {}});
    }
    return timeline;
}

std::vector<double> times(const Timeline& timeline) {
    std::vector<double> all;
    for (const flight::Key& key : timeline.path().keys) {
        all.push_back(key.time);
    }
    return all;
}

TEST(Timeline, TheFirstKeyGoesToTheBegin) {
    Timeline timeline;
    timeline.seek(4);
    timeline.keep({from(10), view::default_transfer_function(), {}});
    EXPECT_EQ(times(timeline), std::vector<double>{0});
    EXPECT_EQ(timeline.at(), 0);
    EXPECT_EQ(timeline.selected(), 0U);
}

TEST(Timeline, KeysStandInOrderAndAreReplacedWhereOneIs) {
    Timeline timeline = three();
    timeline.seek(2);
    timeline.keep({from(50), view::default_transfer_function(), {}});
    EXPECT_EQ(times(timeline), (std::vector<double>{0, 1, 2, 3}));
    timeline.seek(1.004);  // less than half a frame away
    timeline.keep({from(45), view::default_transfer_function(), {}});
    EXPECT_EQ(times(timeline), (std::vector<double>{0, 1, 2, 3}));
    EXPECT_EQ(timeline.path().keys[1].viewpoint.orbit.azimuth, 45);
    EXPECT_TRUE(flight::validate(timeline.path()));
}

TEST(Timeline, AKeyMovesBetweenItsNeighbours) {
    Timeline timeline = three();
    timeline.select(1);
    timeline.move_selected(2.517);
    EXPECT_NEAR(times(timeline)[1], 2.52, 1e-12) << "to a frame";
    timeline.move_selected(9);
    EXPECT_NEAR(times(timeline)[1], 3 - 0.04, 1e-12);
    timeline.move_selected(-5);
    EXPECT_NEAR(times(timeline)[1], 0.04, 1e-12);
    timeline.move_selected(std::nan(""));
    timeline.select(0);
    timeline.move_selected(1);
    EXPECT_EQ(times(timeline)[0], 0) << "the first stays";
    timeline.select(2);
    timeline.move_selected(std::numeric_limits<double>::max());
    EXPECT_EQ(times(timeline)[2], Timeline::longest);
    EXPECT_TRUE(flight::validate(timeline.path()));
}

TEST(Timeline, WithoutItsFirstKeyTheNextOneBegins) {
    Timeline timeline = three();
    timeline.select(0);
    timeline.remove_selected();
    EXPECT_EQ(times(timeline), (std::vector<double>{0, 2}));
    timeline.select(1);
    timeline.remove_selected();
    timeline.select(0);
    timeline.remove_selected();
    EXPECT_TRUE(timeline.empty());
    timeline.remove_selected();
    EXPECT_FALSE(timeline.seen(filmed_lattice));
}

TEST(Timeline, PlaysFromTheNeedleToTheEndByTheClock) {
    Timeline timeline = three();
    const wire::Time now{};
    timeline.seek(1);
    timeline.play(now);
    EXPECT_TRUE(timeline.playing());
    const auto half = timeline.advance(now + 1s, filmed_lattice);
    ASSERT_TRUE(half);
    EXPECT_EQ(half->viewpoint, flight::seen_at(timeline.path(), 2, filmed_lattice).viewpoint);
    EXPECT_DOUBLE_EQ(timeline.at(), 2);
    const auto last = timeline.advance(now + 10s, filmed_lattice);
    ASSERT_TRUE(last);
    EXPECT_EQ(last->viewpoint, from(60));
    EXPECT_FALSE(timeline.playing());
    EXPECT_FALSE(timeline.advance(now + 11s, filmed_lattice));
    timeline.play(now + 20s);  // once more, from the begin
    EXPECT_EQ(timeline.advance(now + 20s, filmed_lattice)->viewpoint, from(0));
    timeline.seek(0.5);
    EXPECT_FALSE(timeline.playing()) << "whoever takes the needle stops it";
}

TEST(Timeline, OneKeyIsNoFlight) {
    Timeline timeline;
    timeline.play({});
    EXPECT_FALSE(timeline.playing());
    timeline.keep({from(3), view::default_transfer_function(), {}});
    timeline.play({});
    EXPECT_FALSE(timeline.playing());
    EXPECT_EQ(timeline.seen(filmed_lattice)->viewpoint, from(3));
}

}  // namespace
}  // namespace shearwater::model
