// A real window: the picture, the camera, the link and what goes wrong.

#include "tests/client/window_fixture.h"

namespace shearwater::window_test {
namespace {

TEST_F(WindowTest, MouseAndKeysChangeThePicture) {
    start_tree();
    open_window();
    const Picture first = lit("the first picture");
    const Light at_first = light_of(first);

    display_->drag(1, middle_x, middle_y, 120, 60);
    other_than(first, "a turn by the mouse");
    display_->key("r");
    like(first, "the view reset by R");

    display_->drag(3, middle_x, middle_y, 80, -40);
    Light moved = light_of(other_than(first, "a pan by the right button"));
    EXPECT_NEAR(moved.x - at_first.x, 80, 12);
    EXPECT_NEAR(moved.y - at_first.y, -40, 12);
    display_->key("r");
    like(first, "the view reset by R again");

    display_->drag(1, middle_x, middle_y, -60, 0, "shift");
    moved = light_of(other_than(first, "a pan by shift and the left button"));
    EXPECT_NEAR(moved.x - at_first.x, -60, 12);
    display_->key("r");
    like(first, "the view reset");

    display_->wheel(middle_x, middle_y, 4);
    const Light larger = light_of(other_than(first, "a zoom by the wheel"));
    EXPECT_GT(larger.spread, at_first.spread * 1.2);
    display_->key("r");
    like(first, "the view reset");

    display_->key("p");
    const Picture parallel = other_than(first, "parallel projection");
    EXPECT_NEAR(light_of(parallel).spread, at_first.spread, at_first.spread * 0.2);
    display_->key("p");
    like(first, "perspective again");

    // The cube's edges, with what its header says along them.
    display_->key("b");
    other_than(first, "the edges and their scales");
    const std::string scales = text_of(folder_ / "controls");
    for (const char* label : {"scale/RA/10h00m", "scale/RA/right ascension", "scale/Dec/+30\u00b0",
                              "scale/Dec/declination", "scale/Vel/radio velocity (km/s)"}) {
        EXPECT_NE(scales.find(label), std::string::npos) << label << " is not among\n" << scales;
    }
    click("camera/boxed");
    like(first, "no edges");
    EXPECT_EQ(text_of(folder_ / "controls").find("scale/"), std::string::npos);
}

// Of this cube every sample counts, so that a high picture takes a while on any machine.
TEST_F(WindowTest, QualityFollowsTheCamera) {
    start_tree("synthetic:random:128");
    open_window({"--target-rate", "60"});
    const auto is_best = [](const Picture& p) { return mark_of(p) == Mark::best; };
    const Picture first = settled(is_best, "the first picture, refined");
    EXPECT_GT(light_of(first).sum, 1e5);

    display_->press(1, middle_x, middle_y);
    const auto end = std::chrono::steady_clock::now() + 150s;
    Picture moving = display_->grab();
    for (int x = 1; mark_of(moving) != Mark::lesser || difference(moving, first) < 0.002; ++x) {
        ASSERT_LT(std::chrono::steady_clock::now(), end) << "no lesser picture came during a drag";
        display_->move(middle_x + x % 200, middle_y);
        moving = display_->grab();
    }
    display_->release(1);
    const Picture turned = settled(is_best, "the picture after a drag, refined");
    EXPECT_GT(difference(turned, first), 0.002);

    // By the panel: always drafts, and as it moves again.
    click("section/CAMERA");
    click("quality/Draft");
    other_than(turned, "a draft of the view at rest");
    click("quality/Auto");
    like(turned, "the view at rest, refined again");
}

// While a hand holds the mouse still the window looks for what it does thirty times a second.
TEST_F(WindowTest, IsDrawnOnlyWhereSomethingChanges) {
    start_tree();
    const auto log = folder_ / "passes";
    open_window({"--pass-log", log.string()});
    settled([](const Picture& p) { return mark_of(p) == Mark::best; }, "the picture, refined");
    display_->press(1, middle_x, middle_y);
    std::this_thread::sleep_for(5s);
    int second = 0, passes = 0, drawn = 0, pictures = 0;
    std::ifstream lines(log);
    while (lines >> second >> passes >> drawn >> pictures) {
    }
    display_->release(1);
    EXPECT_GT(passes, 4) << "in second " << second << ", as at rest";
    EXPECT_LE(drawn, passes / 2) << "in second " << second;
}

TEST_F(WindowTest, ColoursAndOpacityChangeThePicture) {
    start_tree();
    open_window();
    const Picture inferno = lit("the first picture");
    // The last in the menu, one step back over the first: blue at the low end.
    display_->key("shift+c");
    const Picture viridis = other_than(inferno, "the colour map before inferno");
    EXPECT_LT(light_of(viridis).red, light_of(inferno).red - 0.1);
    display_->key("c");
    like(inferno, "inferno again");
    display_->key("i");
    other_than(inferno, "inferno reversed");
    display_->key("i");
    like(inferno, "inferno again");

    // The ramp's lower end is moved to the right.
    drag("editor/handle/low", 90, 0);
    const Picture thinner = other_than(inferno, "the ramp's lower end moved");
    EXPECT_LT(light_of(thinner).sum, light_of(inferno).sum);
}

TEST_F(WindowTest, SurvivesTheServer) {
    open_window();
    std::this_thread::sleep_for(1s);
    start_tree();
    const Picture first = lit("a picture from a server that came after the window");
    display_->drag(1, middle_x, middle_y, 100, 30);
    const Picture turned = other_than(first, "a turn by the mouse");

    tree_->kill_group();
    tree_.reset();
    settled([&](const Picture& p) { return light_of(p).sum < light_of(turned).sum * 0.9; },
            "the last picture, dimmed");
    start_tree();
    like(turned, "the same view from the server started again");
}

TEST_F(WindowTest, ScreenshotIsTakenOnceThePictureIsWhole) {
    start_tree();
    const std::string file = (folder_ / "shot.png").string();
    test::Process shot(client({"--screenshot", file}), environment(), folder_ / "client.log");
    ASSERT_EQ(shot.wait(150s), 0) << text_of(folder_ / "client.log");
    const auto picture = image::read_png(file);
    ASSERT_TRUE(picture) << picture.error().message();
    EXPECT_EQ(picture->width(), width);
    EXPECT_EQ(picture->height(), height);
    EXPECT_GT(light_of(*picture).sum, 1e5);
}

TEST_F(WindowTest, AWrongSecretIsSaid) {
    start_tree();
    secret_ = "another-secret-0123456789";
    // The tree may need a moment to listen; until then the client tries again.
    test::Process shot(client({"--screenshot", (folder_ / "shot.png").string()}), environment(),
                       folder_ / "client.log");
    EXPECT_EQ(shot.wait(150s), 2);
    const std::string said = text_of(folder_ / "client.log");
    EXPECT_NE(said.find("secret"), std::string::npos) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
}

TEST_F(WindowTest, MistakesEndWithTwoAndOneLine) {
    const std::vector<std::vector<std::string>> mistakes = {
        {program("shearwater-client"), "--screenshot", "of-nothing.png"},
        {program("shearwater-client"), "--connect", "localhost:1", "--place", "of-no-command"},
        {program("shearwater-client"), "--connect", "nonsense host:1"},
        {program("shearwater-client"), "--connect", "localhost"},
        {program("shearwater-client"), "--connect", "localhost:1", "--size", "10x10"},
        {program("shearwater-client"), "--connect", "localhost:1", "--tf", "/nowhere/tf.toml"},
        {program("shearwater-client"), "--connect", "localhost:1", "--secret-file", "/nowhere/secret"},
    };
    for (std::size_t i = 0; i < mistakes.size(); ++i) {
        const auto log = folder_ / ("mistake-" + std::to_string(i));
        test::Process process(mistakes[i], environment(), log);
        EXPECT_EQ(process.wait(60s), 2) << i;
        const std::string said = text_of(log);
        EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    }
}

}  // namespace
}  // namespace shearwater::window_test
