// The movie's timeline and the machine's tab in a real window.

#include "common/flight/path_toml.h"
#include "tests/client/window_fixture.h"

namespace shearwater::window_test {
namespace {

TEST_F(WindowTest, AFlightIsMadePlayedAndKept) {
    start_tree();
    open_window();
    const Picture first = lit("the first picture");
    click("dock/Movie");
    click("movie/Key");
    enter("movie/at", "2");
    for (int i = 0; i < 6; ++i) {
        display_->key("Right");
    }
    const Picture turned = other_than(first, "the view turned");
    click("movie/Key");
    control("movie/key/2");  // is there
    const std::string file = (folder_ / "flight.toml").string();
    enter("movie/file", file);
    click("movie/Save");
    ASSERT_TRUE(wait_for([&] { return flight::read_path(file).has_value(); }))
        << text_of(folder_ / "client.log");
    const auto path = flight::read_path(file);
    ASSERT_EQ(path->keys.size(), 2U);
    EXPECT_EQ(path->keys[0].time, 0);
    EXPECT_EQ(path->keys[1].time, 2);
    EXPECT_NEAR(std::abs(path->keys[1].viewpoint.orbit.azimuth - path->keys[0].viewpoint.orbit.azimuth), 30,
                1);

    // The needle takes the view along, and it flies from the begin to the end.
    drag("movie/needle", -130, 0);
    like(first, "the view at the begin");
    click("movie/Play");
    like(turned, "the view at the end");

    // A key that is dragged comes later; without it there is no flight.
    drag("movie/key/2", 60, 0);
    click("movie/Save");
    ASSERT_TRUE(wait_for([&] {
        const auto read = flight::read_path(file);
        return read && read->keys.back().time > 2.1;
    }));
    enter("movie/fps", "30");
    click("movie/Save");
    ASSERT_TRUE(wait_for([&] {
        const auto read = flight::read_path(file);
        return read && read->fps == 30;
    }));
    click("movie/Delete");
    gone("movie/key/2");
    click("movie/Open");
    control("movie/key/2");
    // A click on the strip is a time.
    const Picture now = lit("the view of the path");
    const auto [x, y] = control("movie/strip");
    display_->click(x - 200, y + 40);
    other_than(now, "the view at another time");
}

TEST_F(WindowTest, TheMachineIsShown) {
    start_tree();
    open_window();
    lit("the first picture");
    click("dock/Machine");
    for (const char* node : {"machine/node/0", "machine/node/1", "machine/node/2"}) {
        control(node);
    }
    click("dock/Transfer function");
    gone("machine/node/1");
}

}  // namespace
}  // namespace shearwater::window_test
