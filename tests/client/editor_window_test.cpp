// The editor of transfer functions in a real window: every control by mouse and keys, judged by what it saves
// and by the picture.

#include <gmock/gmock.h>

#include "common/view/anchored_function.h"
#include "tests/client/window_fixture.h"

namespace shearwater::window_test {
namespace {

using testing::HasSubstr;
using view::Blank;
using view::Flat;
using view::Hat;
using view::Ramp;

constexpr double plot_width = 328;  // of a window of that width

class EditorWindowTest : public WindowTest {
  protected:
    std::filesystem::path presets() const { return folder_ / "config" / "shearwater" / "presets"; }

    // The transfer function as the editor has it now: as its list of presets saves it.
    std::string saved_text(const std::string& anchor = "stretched") {
        const std::string name = "probe" + std::to_string(++probes_);
        click("editor/presets");
        enter("editor/preset-name", name);
        choose("editor/anchor", anchor);
        click("editor/preset-save");
        const auto end = std::chrono::steady_clock::now() + 60s;
        while (!std::filesystem::exists(presets() / (name + ".toml"))) {
            std::this_thread::sleep_for(50ms);
            if (std::chrono::steady_clock::now() > end) {
                ADD_FAILURE() << "nothing was saved\n" << text_of(folder_ / "client.log");
                return {};
            }
        }
        close_presets();
        return text_of(presets() / (name + ".toml"));
    }
    void close_presets() {
        display_->key("Escape");
        gone("editor/preset-save");
    }
    void load(const std::string& name) {
        click("editor/presets");
        click("editor/preset/" + name);
        close_presets();
    }
    view::TransferFunction saved() {
        const std::string text = saved_text();
        const auto function = view::transfer_function_from_toml(text, "saved");
        EXPECT_TRUE(function) << text;
        return function ? function->tf : view::TransferFunction();
    }
    Picture opened() {
        start_tree();
        open_window();
        return lit("the first picture");
    }

    int probes_ = 0;
};

template <class Pin>
Pin pin_of(const view::TransferFunction& tf, std::size_t number) {
    EXPECT_LT(number, tf.opacity_pins.size());
    const Pin* pin = number < tf.opacity_pins.size() ? std::get_if<Pin>(&tf.opacity_pins[number]) : nullptr;
    EXPECT_NE(pin, nullptr) << "pin " << number << " is of another kind";
    return pin != nullptr ? *pin : Pin{};
}

TEST_F(EditorWindowTest, PinsAreAddedDraggedTypedRetypedAndDeleted) {
    const Picture first = opened();
    click("editor/add/hat");
    drag("editor/handle/top", 60, -30);
    drag("editor/handle/base-high", 30, 0);
    drag("editor/handle/top-high", 12, 0);
    const auto hats = saved();
    ASSERT_EQ(hats.opacity_pins.size(), 2U);
    EXPECT_EQ(pin_of<Ramp>(hats, 0), (Ramp{0.2, 0, 1, 0.5}));
    const Hat hat = pin_of<Hat>(hats, 1);
    const double per_pixel = (hat.centre - 0.5) / 60;
    EXPECT_NEAR(per_pixel, 1.0 / plot_width, 0.1 / plot_width);
    EXPECT_GT(hat.height, 0.15);
    EXPECT_NEAR(hat.base, 0.2 + 60 * per_pixel, 2 * per_pixel) << "it grows on both sides";
    EXPECT_NEAR(hat.top, 0.1 + 24 * per_pixel, 2 * per_pixel);
    const Picture with_hat = other_than(first, "a hat more");

    enter("editor/field/height", "0.75");
    choose("editor/unit", "stretched");
    enter("editor/field/from", "0.25");
    choose("editor/shape", "triangle");
    click("editor/add/flat");
    drag("editor/handle/height", 0, 25);
    click("editor/add/blank");
    drag("editor/handle/hi", 40, 0);
    // To within a few pixels of the ramp's lower end, which it snaps to.
    const double lo = 0.45, to_ramp = (0.2 - lo) / per_pixel;
    drag("editor/handle/lo", static_cast<int>(to_ramp) + 4, 0, "ctrl");
    const auto more = saved();
    ASSERT_EQ(more.opacity_pins.size(), 4U);
    const Hat triangle = pin_of<Hat>(more, 1);
    EXPECT_EQ(triangle.height, 0.75);
    EXPECT_EQ(triangle.top, 0);
    EXPECT_NEAR(triangle.centre - triangle.base / 2, 0.25, 1e-12);
    EXPECT_GT(pin_of<Flat>(more, 2).height, 0);
    EXPECT_LT(pin_of<Flat>(more, 2).height, 0.1);
    EXPECT_EQ(pin_of<Blank>(more, 3).lo, 0.2);
    EXPECT_NEAR(pin_of<Blank>(more, 3).hi, 0.55 + 40 * per_pixel, 2 * per_pixel);
    const Picture blanked = other_than(with_hat, "much of it blank");

    // By the key, the button, and the menu at a place.
    display_->key("Delete");
    click("editor/add/top-hat");
    click("editor/delete");
    const auto [plot_x, plot_y] = control("editor/plot");
    display_->click(plot_x + 70, plot_y, 1, 3);
    pick("editor/menu/ramp");
    const auto after = saved();
    ASSERT_EQ(after.opacity_pins.size(), 4U);
    const Ramp added = pin_of<Ramp>(after, 3);
    EXPECT_NEAR((added.x0 + added.x1) / 2, 0.5 + 70 * per_pixel, 2 * per_pixel);
    EXPECT_NEAR(added.a1, 0.125, 0.05) << "half-way up on the cube-root axis";
    display_->click(plot_x + 70, plot_y + 20, 1, 3);
    pick("editor/menu/delete");
    // The whole pin is moved by its area: the triangle, under the highest line.
    const auto before_move = pin_of<Hat>(saved(), 1);
    const int x = plot_x + static_cast<int>((before_move.centre - 0.5) / per_pixel) + 6;
    display_->click(x, plot_y + 30);
    display_->drag(1, x, plot_y + 30, -50, 0);
    const auto moved = saved();
    ASSERT_EQ(moved.opacity_pins.size(), 3U);
    EXPECT_NEAR(pin_of<Hat>(moved, 1).centre, before_move.centre - 50 * per_pixel, 2 * per_pixel);
    EXPECT_EQ(pin_of<Hat>(moved, 1).base, before_move.base);
    other_than(blanked, "nothing blank any more");
}

TEST_F(EditorWindowTest, DensityColoursUnitsAndAxes) {
    const Picture first = opened();
    enter("editor/field/density", "4");
    other_than(first, "four times as dense");
    EXPECT_EQ(saved().density, 4);
    drag("editor/density", -20, 0);  // from the middle, which is 1
    const auto thin = saved();
    EXPECT_LT(thin.density, 1);
    EXPECT_GT(thin.density, 0.1);
    const auto [density_x, density_y] = control("editor/density");
    display_->click(density_x, density_y, 1, 3);
    like(first, "as dense as at first");

    choose("editor/map", "heat");
    const Picture heat = other_than(first, "another colour map");
    click("editor/reverse");
    other_than(heat, "the map reversed");
    EXPECT_EQ(view::colour_map_name(saved().colour_pins), "heat-r");
    choose("editor/map", "grey");
    const auto [bar_x, bar_y] = control("editor/colours");
    // On a slow machine two clicks may fall into one pass; more of them add no second pin there.
    for (int tries = 0; tries < 10 && !has_control("editor/colour/2"); ++tries) {
        display_->click(bar_x - 60, bar_y - 4, 2);
        std::this_thread::sleep_for(500ms);
    }
    drag("editor/colour/1", 30, 0);
    drag("editor/rgb", 40, 0);  // the middle one of three numbers, and the others stay
    const auto own = saved();
    ASSERT_EQ(own.colour_pins.size(), 3U);
    EXPECT_NEAR(own.colour_pins[1].at, 1 - own.colour_pins[1].rgb.r + 30 / plot_width, 0.02)
        << "still reversed";
    EXPECT_EQ(own.colour_pins[1].rgb.r, own.colour_pins[1].rgb.b);
    EXPECT_GT(own.colour_pins[1].rgb.g, own.colour_pins[1].rgb.r + 0.05);
    display_->key("Delete");
    EXPECT_EQ(view::colour_map_name(saved().colour_pins), "grey-r");
    click("editor/reverse");
    choose("editor/map", "inferno");
    like(first, "inferno again");

    // A percentile that is typed is what is kept.
    const auto [plot_x, plot_y] = control("editor/plot");
    display_->click(plot_x + 100, plot_y + 40);
    choose("editor/unit", "percentile");
    enter("editor/field/x0", "97");
    const std::string by_percentile = saved_text("percentile");
    EXPECT_THAT(by_percentile, HasSubstr("unit = \"percentile\""));
    const auto function = view::transfer_function_from_toml(by_percentile, "saved");
    ASSERT_TRUE(function) << by_percentile;
    EXPECT_NEAR(pin_of<Ramp>(function->tf, 0).x0, 97, 0.01);
    choose("editor/unit", "sigma");
    enter("editor/field/x0", "5");
    const auto by_sigma = view::transfer_function_from_toml(saved_text("sigma"), "saved");
    ASSERT_TRUE(by_sigma);
    EXPECT_NEAR(pin_of<Ramp>(by_sigma->tf, 0).x0, 5, 1e-6);

    // Of the axes the linear one has the same opacity in another place.
    const auto on_root = control("editor/handle/high");
    choose("editor/axis", "linear");
    EXPECT_GT(control("editor/handle/high").second, on_root.second + 20);
    choose("editor/axis", "log");
    EXPECT_LT(control("editor/handle/high").second, on_root.second);
}

TEST_F(EditorWindowTest, PresetsAreKeptLoadedRenamedAndDeleted) {
    const Picture first = opened();
    ASSERT_TRUE(!saved_text().empty());  // probe1: as it was at first
    drag("editor/handle/low", 120, 0);
    const Picture thin = other_than(first, "less opacity");
    const std::string thinner = saved_text("value");  // probe2
    EXPECT_THAT(thinner, HasSubstr("unit = \"value\""));
    load("probe1");
    like(first, "the first preset");
    load("probe2");
    like(thin, "the second preset");

    click("editor/presets");
    enter("editor/preset-name", "thin gas");
    click("editor/preset-rename");
    control("editor/preset/thin gas");
    EXPECT_EQ(text_of(presets() / "thin gas.toml"), thinner);
    EXPECT_FALSE(std::filesystem::exists(presets() / "probe2.toml"));

    // What others have put there is listed, and when it is no transfer function nothing changes.
    std::ofstream(presets() / "bad.toml") << "[[opacity]]\nkind = \"slope\"\n";
    close_presets();
    load("bad");
    like(thin, "what was there before the bad file");
    click("editor/presets");
    click("editor/preset-delete");
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (std::filesystem::exists(presets() / "bad.toml") && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(50ms);
    }
    EXPECT_FALSE(std::filesystem::exists(presets() / "bad.toml"));
    close_presets();

    // The files are those of --tf, in whatever unit.
    window_.reset();
    open_window({"--tf", (presets() / "thin gas.toml").string()});
    pick("offer/dismiss");  // the first window did not end well
    like(thin, "the preset given on the command line");

    display_->key("e");
    gone("editor/plot");
    display_->key("e");
    like(thin, "the dock shown again");
}

}  // namespace
}  // namespace shearwater::window_test
