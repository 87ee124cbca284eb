// What was done with mouse and keys during a pass, however long, reaches Dear ImGui in its order.

#include "client/view/input_events.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "tests/client/graphics_fixture.h"

namespace shearwater::ui {
namespace {

class InputEventsTest : public GraphicsTest {
  protected:
    // What a pass saw of a button of Dear ImGui's that fills the window.
    struct Pass {
        bool activated, active, deactivated;
        ImVec2 mouse, moved;
    };
    Pass pass() {
        window_->begin(0.01);
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({480, 320});
        ImGui::Begin("all", nullptr, ImGuiWindowFlags_NoDecoration);
        ImGui::SetCursorScreenPos({10, 10});
        ImGui::InvisibleButton("button", {460, 300});
        const ImGuiIO& io = ImGui::GetIO();
        const Pass seen{ImGui::IsItemActivated(), ImGui::IsItemActive(), ImGui::IsItemDeactivated(),
                        io.MousePos, io.MouseDelta};
        ImGui::End();
        window_->draw({});
        return seen;
    }
    // All that an action of the mouse leads to; the action is over before the first pass.
    std::vector<Pass> passes_after(const std::function<void()>& action) {
        for (int n = 0; n < 10; ++n) {  // what the display has to say of a new window
            pass();
        }
        action();
        std::vector<Pass> passes(20);
        std::ranges::generate(passes, [&] { return pass(); });
        return passes;
    }
};

TEST_F(InputEventsTest, ADragIsAsLongAsItWasThoughItIsSeenAtItsEnd) {
    const auto passes = passes_after([&] { display_->drag(1, 100, 200, 60, -30); });
    const auto first = std::ranges::find(passes, true, &Pass::activated);
    const auto last = std::ranges::find(passes, true, &Pass::deactivated);
    ASSERT_NE(first, passes.end());
    ASSERT_NE(last, passes.end());
    EXPECT_EQ(first->mouse.x, 100);
    EXPECT_EQ(first->mouse.y, 200);
    ImVec2 dragged{0, 0};
    for (auto each = first + 1; each != last; ++each) {
        EXPECT_TRUE(each->active);
        dragged.x += each->moved.x;
        dragged.y += each->moved.y;
    }
    EXPECT_EQ(dragged.x, 60);
    EXPECT_EQ(dragged.y, -30);
    EXPECT_EQ(last->mouse.x, 160) << "it is let go where it was";
    EXPECT_EQ(passes.back().mouse.x, 1) << "then it is seen where it is";
}

TEST_F(InputEventsTest, PressesAreAsManyAsTheyWereAndWhereTheyWere) {
    const auto passes = passes_after([&] {
        display_->click(50, 60, 2);
        display_->click(300, 200);
    });
    std::vector<float> xs;
    for (const Pass& each : passes) {
        if (each.activated) {
            xs.push_back(each.mouse.x);
        }
    }
    EXPECT_EQ(xs, (std::vector<float>{50, 50, 300}));
    EXPECT_FALSE(passes.back().active);
}

// Selected, overwritten, gone through and mended, all before a pass.
TEST_F(InputEventsTest, KeysAndWhatTheyTypeComeInTheirOrder) {
    std::array<char, 64> text{"before"};
    const auto field = [&] {
        window_->begin(0.01);
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({480, 320});
        ImGui::Begin("all", nullptr, ImGuiWindowFlags_NoDecoration);
        ImGui::SetCursorScreenPos({10, 10});
        ImGui::InputText("##field", text.data(), text.size());
        ImGui::End();
        window_->draw({});
    };
    for (int n = 0; n < 10; ++n) {
        field();
    }
    display_->click(50, 18);
    display_->tap("ctrl+a");
    display_->type("Yello W");
    display_->tap("Home");
    display_->tap("Delete");
    display_->type("H");
    display_->tap("End");
    display_->tap("BackSpace");
    display_->tap("BackSpace");
    display_->type("!");
    for (int n = 0; n < 200; ++n) {
        field();
    }
    EXPECT_STREQ(text.data(), "Hello!");
    std::vector<int> pressed;
    for (const KeyPress& press : window_->take_keys()) {
        if (press.control) {
            pressed.push_back(press.key);
        }
    }
    EXPECT_EQ(pressed, std::vector<int>{GLFW_KEY_A});
}

TEST(InputEvents, WhatIsNotKnownIsNotKept) {
    InputEvents events;
    events.button(7, true);
    events.button(-1, true);
    events.key({GLFW_KEY_UNKNOWN, false, false});
    events.release(GLFW_KEY_LAST + 1);
    EXPECT_FALSE(events.are_behind());
}

TEST(InputEvents, AModifierIsDownWithTheKeyThatItCameBefore) {
    InputEvents events;
    ImGuiIO io;
    events.key({GLFW_KEY_LEFT_CONTROL, false, true});
    events.key({GLFW_KEY_A, false, true});
    events.release(GLFW_KEY_LEFT_CONTROL);
    events.release(GLFW_KEY_A);
    events.play(io);
    EXPECT_TRUE(io.KeyCtrl && io.KeysDown[GLFW_KEY_A]);
    events.play(io);
    EXPECT_FALSE(io.KeyCtrl);
    EXPECT_FALSE(io.KeysDown[GLFW_KEY_A]) << "a modifier's own end is not waited for";
    EXPECT_FALSE(events.are_behind());
}

}  // namespace
}  // namespace shearwater::ui
