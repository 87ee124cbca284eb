// Limits and stretches by the panel of a real window.

#include "tests/client/window_fixture.h"

namespace shearwater::window_test {
namespace {

TEST_F(WindowTest, LimitsAndStretchesAreChosenTypedAndTakenBack) {
    start_tree();
    open_window();
    const Picture first = lit("the first picture");
    click("limits/hold");  // pins are to stay where they are between the limits
    click("limits/log");
    const Picture stretched = other_than(first, "another stretch");
    EXPECT_GT(light_of(stretched).sum, light_of(first).sum) << "faint values are lifted";
    click("limits/served");
    like(first, "as it was served");

    enter("limits/high", "1e9");
    const Picture dark = settled([&](const Picture& p) { return difference(p, first) > 0.002; }, "all below");
    EXPECT_LT(light_of(dark).sum, light_of(first).sum);
    display_->key("ctrl+z");
    like(first, "undone");

    // At their values the pins draw the same through other limits, but for what lies between codes.
    click("limits/hold");
    click("limits/min/max");
    const Picture held =
        settled([&](const Picture& p) { return difference(p, first) > 0.0005 && light_of(p).sum > 1e4; },
                "pins at their values");
    EXPECT_LT(difference(held, first), 0.5);
}

}  // namespace
}  // namespace shearwater::window_test
