// What only one eye sees of a pass, in a real graphics context.

#include "client/view/eye_gates.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "client/view/window.h"
#include "tests/support/window_driver.h"

// Graphics drivers keep what they allocate: leaks are looked for in every other test.
extern "C" const char* __asan_default_options();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier)
    return "detect_leaks=0";
}

namespace shearwater::ui {
namespace {

class EyeGatesTest : public testing::Test {
  protected:
    void SetUp() override {
        if (const std::string why = test::Display::unavailable(); !why.empty()) {
            GTEST_SKIP() << why;
        }
        display_ = std::make_unique<test::Display>(640, 480);
        setenv("DISPLAY", display_->name().c_str(), 1);
        setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
        auto window = Window::open({.width = 480, .height = 320, .scale = 1});
        ASSERT_TRUE(window) << window.error().message();
        window_ = *std::move(window);
    }

    // Three squares: the left eye's in red, the right one's in blue, and one in green for both.
    void draw_pass() {
        window_->begin(0.01);
        ImDrawList& list = *ImGui::GetBackgroundDrawList();
        const auto square = [&](float x, ImU32 colour) {
            list.AddRectFilled({x, 100}, {x + 50, 150}, colour);
        };
        window_->gates().only(list, Eye::left);
        square(100, IM_COL32(255, 0, 0, 255));
        EyeGates::both(list);
        window_->gates().only(list, Eye::right);
        square(200, IM_COL32(0, 0, 255, 255));
        EyeGates::both(list);
        square(300, IM_COL32(0, 255, 0, 255));
        window_->draw();
    }
    static bool is_lit(const test::Picture& picture, int x) {
        const image::Rgba8& p = picture.at(x + 25, 125);
        return std::max({p.r, p.g, p.b}) > 200;
    }

    std::unique_ptr<test::Display> display_;
    std::unique_ptr<Window> window_;
};

TEST_F(EyeGatesTest, EachEyeSeesItsOwnAndWhatIsBoths) {
    draw_pass();
    const test::Picture left = window_->read_pixels();
    EXPECT_TRUE(is_lit(left, 100));
    EXPECT_FALSE(is_lit(left, 200));
    EXPECT_TRUE(is_lit(left, 300));
    window_->draw_for(Eye::right);
    const test::Picture right = window_->read_pixels();
    EXPECT_FALSE(is_lit(right, 100));
    EXPECT_TRUE(is_lit(right, 200));
    EXPECT_TRUE(is_lit(right, 300));
}

// A gate that is left open or shut by one eye's drawing is not by the next.
TEST_F(EyeGatesTest, ThePassAfterIsWhole) {
    window_->begin(0.01);
    window_->gates().only(*ImGui::GetBackgroundDrawList(), Eye::right);
    window_->draw();
    draw_pass();
    const test::Picture left = window_->read_pixels();
    EXPECT_TRUE(is_lit(left, 100));
    EXPECT_FALSE(is_lit(left, 200));
}

}  // namespace
}  // namespace shearwater::ui
