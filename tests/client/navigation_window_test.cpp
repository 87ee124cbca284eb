// Every way to move the view in a real window, and what is kept of it in files.

#include "tests/client/session_window_fixture.h"
#include "tests/support/desktop.h"

namespace shearwater::window_test {
namespace {

class NavigationTest : public SessionWindowTest {
  protected:
    // Of its viewpoint.
    view::Viewpoint viewpoint(const std::function<bool(const view::Viewpoint&)>& holds, const char* what) {
        return saved([&](const scene::Scene& scene) { return holds(scene.viewpoint); }, what).viewpoint;
    }
    view::Viewpoint at_orbit(double azimuth, double elevation, double roll, const char* what) {
        return viewpoint(
            [=](const view::Viewpoint& v) {
                return std::abs(v.orbit.azimuth - azimuth) < 1e-6 &&
                       std::abs(v.orbit.elevation - elevation) < 1e-6 && std::abs(v.orbit.roll - roll) < 1e-6;
            },
            what);
    }
    // A double click selects what is there.
    void type(const std::string& name, const std::string& text) {
        click(name, 2);
        display_->type(text);
        display_->hold("Return", 400ms);  // the widget sees only what is down in a pass
    }
};

TEST_F(NavigationTest, EveryControlMovesTheView) {
    const Picture first = lit("the first picture");
    const view::Viewpoint begin = at_orbit(20, 20, 0, "the session that it was opened with");

    // Keys: sides, fit, reset.
    display_->key("5");
    at_orbit(0, 0, 0, "from +z");
    const Picture from_z = other_than(first, "the picture from +z");
    display_->key("0");
    const view::Viewpoint fitted =
        viewpoint([](const view::Viewpoint& v) { return v.orbit.distance > 0; }, "fitted in");
    EXPECT_NE(fitted.orbit.distance, begin.orbit.distance);
    EXPECT_GT(light_of(other_than(from_z, "the picture fitted in")).spread, light_of(from_z).spread);
    display_->key("r");
    viewpoint([](const view::Viewpoint& v) { return v == view::Viewpoint{}; }, "reset by R");

    // The same by buttons.
    click("camera/-x");
    at_orbit(-90, 0, 0, "from -x");
    click("camera/Fit");
    viewpoint([](const view::Viewpoint& v) { return v.orbit.distance > 0; }, "fitted in by a button");
    click("camera/Parallel");
    viewpoint([](const view::Viewpoint& v) { return v.projection == view::Projection::parallel; },
              "parallel");
    display_->key("p");
    viewpoint([](const view::Viewpoint& v) { return v.projection == view::Projection::perspective; },
              "perspective");
    click("camera/Reset");
    viewpoint([](const view::Viewpoint& v) { return v == view::Viewpoint{}; }, "reset by a button");
    const Picture at_rest = lit("the view reset");

    // Roll, by keys and by the mouse.
    display_->key("period");
    at_orbit(30, 20, 5, "rolled by a key");
    other_than(at_rest, "the picture rolled");
    display_->key("comma");
    at_orbit(30, 20, 0, "rolled back");
    display_->drag(1, middle_x + 150, middle_y, 0, 150, "alt");
    viewpoint([](const view::Viewpoint& v) { return std::abs(v.orbit.roll + 45) < 1; },
              "rolled by the mouse");

    // Undo and redo.
    display_->key("ctrl+z");
    at_orbit(30, 20, 0, "undone");
    like(at_rest, "the picture before the roll");
    display_->key("ctrl+y");
    viewpoint([](const view::Viewpoint& v) { return std::abs(v.orbit.roll + 45) < 1; }, "done again");
    display_->key("ctrl+z");
    at_orbit(30, 20, 0, "undone again");

    // Typed numbers; what is out of range changes nothing.
    click("section/CUBE");
    click("camera/numbers");
    type("camera/azimuth", "75");
    at_orbit(75, 20, 0, "an azimuth typed");
    type("camera/elevation", "123");
    type("camera/roll", "-30");
    at_orbit(75, 20, -30, "a roll typed, and an elevation refused");
    type("camera/target-x", "30");  // voxels, of 48
    viewpoint([](const view::Viewpoint& v) { return std::abs(v.orbit.target.x - 6.5) < 1e-6; },
              "a target typed");
    click("camera/numbers");
    click("section/CUBE");
}

TEST_F(NavigationTest, FliesAndPicks) {
    const Picture first = lit("the first picture");
    const view::Lattice lattice{.n = {48, 40, 44}};
    display_->key("f");
    const view::Viewpoint aloft =
        viewpoint([](const view::Viewpoint& v) { return v.orbit.distance > 0; }, "flying");
    like(first, "the picture as before");
    display_->hold("w", 700ms);
    const view::Viewpoint ahead = viewpoint(
        [&](const view::Viewpoint& v) { return glm::distance(v.orbit.target, aloft.orbit.target) > 1; },
        "flown ahead");
    const view::Vec3 way = ahead.orbit.target - aloft.orbit.target;
    EXPECT_GT(glm::dot(glm::normalize(way), -view::picture_axes(aloft.orbit).back), 0.999);
    EXPECT_GT(light_of(other_than(first, "the cube nearer")).spread, light_of(first).spread);
    display_->drag(1, middle_x, middle_y, 60, 0);
    const view::Viewpoint turned = viewpoint(
        [&](const view::Viewpoint& v) { return v.orbit.azimuth != ahead.orbit.azimuth; }, "looked around");
    EXPECT_NEAR(glm::distance(camera(turned, lattice).eye, camera(ahead, lattice).eye), 0, 1e-6);
    display_->key("Escape");
    display_->drag(1, middle_x, middle_y, 40, 0);
    viewpoint(
        [&](const view::Viewpoint& v) {
            return v.orbit.azimuth != turned.orbit.azimuth && v.orbit.target == turned.orbit.target;
        },
        "landed: a drag turns about the target");
    display_->key("r");
    viewpoint([](const view::Viewpoint& v) { return v == view::Viewpoint{}; }, "reset");

    // What is under the cursor becomes the pivot and comes to the middle.
    const Light light = light_of(lit("the view reset"));
    display_->click(static_cast<int>(light.x) - 20, static_cast<int>(light.y) + 6, 2);
    const view::Viewpoint pivoted = viewpoint(
        [](const view::Viewpoint& v) { return v.orbit.target != view::Vec3(0); }, "turning about a voxel");
    const view::Vec3 voxel = lattice.voxel_from_world(pivoted.orbit.target);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(voxel[axis], -1e-6);
        EXPECT_LE(voxel[axis], static_cast<double>(lattice.n[static_cast<std::size_t>(axis)] - 1) + 1e-6);
    }
    // And is read: the tooltip covers some of the picture.
    const Picture before = lit("the picture turned about a voxel");
    display_->key("v");
    display_->move(middle_x, middle_y);
    ASSERT_TRUE(wait_for([&] { return difference(display_->grab(), before) > 0.002; }))
        << "no reading is shown";
    display_->key("v");
    display_->move(1, 1);
    like(before, "the reading gone");
}

TEST_F(NavigationTest, KeepsItsViewInFiles) {
    lit("the first picture");
    display_->drag(1, middle_x, middle_y, 70, -30);
    display_->key("period");
    display_->key("shift+c");
    const scene::Scene kept =
        saved([](const scene::Scene& scene) { return scene.viewpoint.orbit.roll == 5; }, "turned and rolled");

    // The picture carries the session, and is what a still of it is.
    const std::string picture = (folder_ / "view.png").string();
    display_->key("ctrl+p");
    ASSERT_TRUE(wait_for([&] { return image::is_png(picture); })) << text_of(folder_ / "client.log");
    EXPECT_EQ(scene::read(picture).value(), kept);
    const std::string still = (folder_ / "still.png").string();
    test::Process snapshot(
        {program("shearwater"), "snapshot", "--connect", server(), "--session", picture, "-o", still},
        environment_, folder_ / "snapshot.log");
    ASSERT_EQ(snapshot.wait(120s), 0) << text_of(folder_ / "snapshot.log");
    const auto of_window = image::read_png(picture), of_still = image::read_png(still);
    ASSERT_TRUE(of_window && of_still);
    ASSERT_EQ(of_window->width(), of_still->width());
    EXPECT_TRUE(std::ranges::equal(of_window->pixels(), of_still->pixels()));

    // Dropped back in, it brings its view back.
    display_->drag(1, middle_x, middle_y, -50, 20);
    display_->key("period");
    saved([](const scene::Scene& scene) { return scene.viewpoint.orbit.roll == 10; }, "turned on");
    ASSERT_EQ(test::drop_file(display_->name(), picture, middle_x, middle_y), "");
    ASSERT_TRUE(wait_for([&] {
        display_->key("ctrl+s");
        const auto now = scene::read((folder_ / "view.toml").string());
        return now && *now == kept;
    })) << "the picture's view is not back";

    // What is no session changes nothing.
    { std::ofstream(folder_ / "view.toml") << "version = 1\ncube = \""; }
    display_->key("ctrl+o");
    std::this_thread::sleep_for(300ms);
    std::filesystem::remove(folder_ / "view.toml");
    EXPECT_EQ(saved([](const scene::Scene&) { return true; }, "saved again"), kept);

    // A window that does not end well leaves its view behind, for the next one on the same cube.
    display_->key("comma");
    display_->key("comma");
    const scene::Scene last =
        saved([](const scene::Scene& scene) { return scene.viewpoint.orbit.roll == -5; }, "rolled back");
    const auto autosaved = [&] {
        std::error_code none;
        for (const auto& entry : std::filesystem::directory_iterator(folder_ / "state/shearwater", none)) {
            const auto read = scene::read(entry.path().string());
            if (read && read->viewpoint == last.viewpoint) {
                return true;
            }
        }
        return false;
    };
    ASSERT_TRUE(wait_for(autosaved)) << "nothing is kept for after a crash";
    window_->kill_group();
    window_->wait(10s);
    first_session();
    open({"--session", (folder_ / "view.toml").string()});
    click("offer/restore");
    EXPECT_EQ(saved([&](const scene::Scene& scene) { return scene.viewpoint == last.viewpoint; }, "restored"),
              last);

    // One that does leaves nothing but where it has been.
    display_->key("ctrl+q");
    ASSERT_EQ(window_->wait(30s), 0);
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "state/shearwater")) {
        EXPECT_EQ(entry.path().filename(), "recent.toml");
    }
}

}  // namespace
}  // namespace shearwater::window_test
