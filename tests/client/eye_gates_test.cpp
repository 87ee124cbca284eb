// What only one eye sees of a pass, in a real graphics context.

#include "client/view/eye_gates.h"

#include "tests/client/graphics_fixture.h"

namespace shearwater::ui {
namespace {

class EyeGatesTest : public GraphicsTest {
  protected:
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
        window_->draw({.anyway = true});
    }
    static bool is_lit(const test::Picture& picture, int x) {
        const image::Rgba8& p = picture.at(x + 25, 125);
        return std::max({p.r, p.g, p.b}) > 200;
    }
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
    window_->draw({.anyway = true});
    draw_pass();
    const test::Picture left = window_->read_pixels();
    EXPECT_TRUE(is_lit(left, 100));
    EXPECT_FALSE(is_lit(left, 200));
}

}  // namespace
}  // namespace shearwater::ui
