// Each control of the panel and the editor that no other test needs: what it does to the view that the window
// keeps, and to the picture.

#include "tests/client/session_window_fixture.h"

namespace shearwater::window_test {
namespace {

using scene::Scene;

class ControlsTest : public SessionWindowTest {
  protected:
    ControlsTest() { screen_width_ = width + 200; }

    void does(const std::string& name, const std::function<bool(const Scene&)>& holds) {
        click(name);
        saved(holds, name.c_str());
    }
    void looks(const std::string& name, double azimuth, double elevation) {
        does(name, [=](const Scene& scene) {
            const view::Orbit& orbit = scene.viewpoint.orbit;
            return std::abs(orbit.azimuth - azimuth) < 1e-6 && std::abs(orbit.elevation - elevation) < 1e-6;
        });
    }
    // A share of a slider's width from its left.
    void slide(const std::string& name, double along) {
        const auto [x, y] = control(name);
        display_->click(x + static_cast<int>((along - 0.5) * 270), y);
    }
};

TEST_F(ControlsTest, Camera) {
    const Picture first = lit("the first picture");
    looks("camera/+x", 90, 0);
    looks("camera/+y", 0, 90);
    looks("camera/-y", 0, -90);
    looks("camera/-z", 180, 0);
    looks("camera/+z", 0, 0);
    const Picture near = other_than(first, "the picture from +z");
    slide("camera/fov", 0.7);
    saved([](const Scene& scene) { return scene.viewpoint.fov > 40; }, "a wider field of view");
    EXPECT_LT(light_of(other_than(near, "the picture farther")).spread, light_of(near).spread);
    click("camera/Parallel");
    does("camera/Perspective",
         [](const Scene& scene) { return scene.viewpoint.projection == view::Projection::perspective; });
    click("camera/Fly");
    click("camera/Land");
    control("camera/Fly");
}

TEST_F(ControlsTest, Keys) {
    const std::array<std::pair<double, double>, 6> sides{
        {{90, 0}, {-90, 0}, {0, 90}, {0, -90}, {0, 0}, {180, 0}}};
    const auto stands = [&](double azimuth, double elevation, const char* what) {
        saved(
            [=](const Scene& scene) {
                const view::Orbit& orbit = scene.viewpoint.orbit;
                return std::abs(orbit.azimuth - azimuth) < 1e-6 &&
                       std::abs(orbit.elevation - elevation) < 1e-6;
            },
            what);
    };
    for (std::size_t n = 0; n < sides.size(); ++n) {
        const std::string key = std::to_string(n + 1);
        display_->tap(key);
        stands(sides[n].first, sides[n].second, key.c_str());
    }
    display_->tap("5");
    stands(0, 0, "from +z");
    // Arrows turn what is seen, by five degrees.
    for (const auto& [key, azimuth, elevation] : {std::tuple{"Left", -5, 0}, std::tuple{"Right", 0, 0},
                                                  std::tuple{"Up", 0, 5}, std::tuple{"Down", 0, 0}}) {
        display_->tap(key);
        stands(azimuth, elevation, key);
    }
    const auto distance = [&](const std::function<bool(double)>& holds, const char* what) {
        return saved([&](const Scene& scene) { return holds(scene.viewpoint.orbit.distance); }, what)
            .viewpoint.orbit.distance;
    };
    display_->tap("equal");
    const double near = distance([](double d) { return d > 0; }, "nearer");
    display_->tap("minus");
    distance([&](double d) { return d > near; }, "farther");

    // Flying, to all sides.
    display_->tap("f");
    control("camera/Land");
    view::Vec3 before = saved([](const Scene&) { return true; }, "aloft").viewpoint.orbit.target;
    for (const char* key : {"s", "a", "d", "space", "x"}) {
        display_->hold(key, 300ms);
        before = saved([&](const Scene& scene) { return scene.viewpoint.orbit.target != before; }, key)
                     .viewpoint.orbit.target;
    }
    display_->tap("f");
    control("camera/Fly");

    const std::string map =
        view::colour_map_name(saved([](const Scene&) { return true; }, "colours").tf.colour_pins);
    display_->tap("i");
    saved([&](const Scene& scene) { return view::colour_map_name(scene.tf.colour_pins) != map; }, "reversed");
    for (const auto& [key, hides] : {std::pair{"e", "editor/plot"}, std::pair{"Tab", "camera/Fit"}}) {
        display_->tap(key);
        gone(hides);
        display_->tap(key);
        control(hides);
    }
    display_->tap("ctrl+n");
    control("connect/Close");
    display_->tap("Escape");
    gone("connect/Close");

    const int at = control("camera/Fit").first;
    display_->tap("F11");
    EXPECT_TRUE(wait_for([&] { return control("camera/Fit").first > at; })) << "it does not fill the display";
    display_->tap("F11");
    EXPECT_TRUE(wait_for([&] { return control("camera/Fit").first == at; }))
        << "it goes on filling the display";
}

TEST_F(ControlsTest, Limits) {
    const Picture first = lit("the first picture");
    const auto with_stretch = [](volume::Stretch stretch) {
        return [=](const Scene& scene) { return scene.scaling && scene.scaling->stretch == stretch; };
    };
    does("limits/asinh", with_stretch(volume::Stretch::asinh));
    does("limits/sqrt", with_stretch(volume::Stretch::sqrt));
    does("limits/linear", with_stretch(volume::Stretch::linear));
    double above = HUGE_VAL;
    for (const char* percentile : {"limits/99.9", "limits/99.5", "limits/99", "limits/95"}) {
        does(percentile, [&](const Scene& scene) { return scene.scaling && scene.scaling->hi < above; });
        above = saved([](const Scene& scene) { return scene.scaling.has_value(); }, percentile).scaling->hi;
    }
    const volume::Scaling before = *saved([](const Scene&) { return true; }, "limits").scaling;
    does("limits/zscale", [&](const Scene& scene) { return scene.scaling && *scene.scaling != before; });
    enter("limits/low", "-0.5");
    saved([](const Scene& scene) { return scene.scaling && scene.scaling->lo == -0.5; }, "a limit typed");
    settled([&](const Picture& p) { return difference(p, first) > 0.002; }, "the picture by them");
}

TEST_F(ControlsTest, QualityAndSession) {
    const Picture first = lit("the first picture");
    const auto with_quality = [](view::Quality quality) {
        return [=](const Scene& scene) { return scene.quality == quality; };
    };
    does("quality/Normal", with_quality(view::Quality::normal));
    does("quality/High", with_quality(view::Quality::high));
    does("quality/Auto", [](const Scene& scene) { return !scene.quality; });
    slide("quality/rate", 0.8);
    saved([](const Scene& scene) { return scene.target_rate > 35; }, "a higher rate");
    does("quality/culling", [](const Scene& scene) { return scene.culling.kind == culling::Kind::opof; });
    like(first, "what is hidden left out");
    does("quality/culling", [](const Scene& scene) { return scene.culling.kind == culling::Kind::off; });

    // The session's buttons do as its keys.
    click("section/LIMITS");
    click("section/SESSION");
    looks("camera/-x", -90, 0);
    const Picture turned = other_than(first, "the picture from -x");
    click("session/Undo");
    like(first, "undone");
    click("session/Redo");
    like(turned, "done again");
    const std::string other = (folder_ / "other.toml").string();
    enter("session/file", other);
    click("session/Save");
    ASSERT_TRUE(wait_for([&] { return scene::read(other).has_value(); }));
    EXPECT_EQ(scene::read(other)->viewpoint.orbit.azimuth, -90);
    click("camera/+z");
    other_than(turned, "the picture from +z");
    click("session/Open");
    like(turned, "the session's picture");
    click("session/Picture");
    ASSERT_TRUE(wait_for([&] { return image::is_png((folder_ / "other.png").string()); }));
}

TEST_F(ControlsTest, CropByEverySliderAndHandle) {
    for (const char* title : {"section/QUALITY AND SPEED", "section/LIMITS", "section/CUBE"}) {
        click(title);
    }
    const Picture first = lit("the first picture");
    click("section/CROP");
    const Picture whole = other_than(first, "the cube's edges");
    const auto moved = [](int axis, bool upper) {
        return [=](const Scene& scene) {
            constexpr std::array<std::int64_t, 3> last{47, 39, 43};
            const auto a = static_cast<std::size_t>(axis);
            return scene.crop && (upper ? scene.crop->hi[a] < last[a] : scene.crop->lo[a] > 0);
        };
    };
    for (int axis = 0; axis < 3; ++axis) {
        for (const int end : {0, 1}) {
            const std::string name = std::string("crop/") + "xyz"[axis] + "01"[end];
            slide(name, end == 0 ? 0.3 : 0.7);
            saved(moved(axis, end == 1), name.c_str());
        }
    }
    other_than(whole, "a smaller box");
    click("crop/reset");
    like(whole, "all of it");
    // Inwards, as the view from a little above and aside has them.
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool upper : {false, true}) {
            const std::string name = std::string("crop/") + "xyz"[axis] + (upper ? "-upper" : "-lower");
            const auto [x, y] = control(name);
            const int dx = middle_x - x, dy = middle_y - y;
            display_->drag(1, x, y, dx / 3, dy / 3);
            saved(moved(axis, upper), name.c_str());
        }
    }
    click("crop/reset");
    saved([](const Scene& scene) { return !scene.crop; }, "no box");
}

TEST_F(ControlsTest, EveryWayToShowAPair) {
    for (const char* title : {"section/QUALITY AND SPEED", "section/LIMITS", "section/CUBE"}) {
        click(title);
    }
    Picture before = lit("the first picture");
    click("section/STEREO");
    for (std::size_t n = 0; n < image::stereo_mode_names.size(); ++n) {
        const auto mode = static_cast<image::StereoMode>(n);
        if (mode == image::StereoMode::quad_buffered || mode == image::StereoMode::two_windows) {
            continue;
        }
        const std::string name(image::stereo_mode_names[n]);
        click("stereo/mode");
        click("stereo/mode/" + name);
        saved([&](const Scene& scene) { return scene.stereo && scene.stereo->mode == mode; }, name.c_str());
        before = other_than(before, name.c_str());
    }
    slide("stereo/convergence", 0.8);
    saved([](const Scene& scene) { return scene.stereo && scene.stereo->eyes.convergence > 0; },
          "convergence");
    slide("stereo/separation", 0.9);
    saved([](const Scene& scene) { return scene.stereo && scene.stereo->eyes.separation > 0; }, "separation");

    // A display without the buffers keeps the mode it had.
    click("stereo/mode");
    click("stereo/mode/quad-buffered");
    display_->key("Escape");
    saved([](const Scene& scene) { return scene.stereo && scene.stereo->mode == image::StereoMode::right; },
          "the mode before");
}

TEST_F(ControlsTest, EveryShapeAndColourMap) {
    const Picture first = lit("the first picture");
    for (const std::string& name : view::colour_map_names()) {
        choose("editor/map", name);
        saved([&](const Scene& scene) { return view::colour_map_name(scene.tf.colour_pins) == name; },
              name.c_str());
    }
    other_than(first, "the last map's picture");
    std::size_t pins = saved([](const Scene&) { return true; }, "pins").tf.opacity_pins.size();
    for (const char* name : {"ramp", "triangle"}) {
        click(std::string("editor/add/") + name);
        ++pins;
        saved([&](const Scene& scene) { return scene.tf.opacity_pins.size() == pins; }, name);
    }
    other_than(first, "more pins");
    for (const char* axis : {"linear", "log"}) {
        choose("editor/axis", axis);
    }
}

}  // namespace
}  // namespace shearwater::window_test
