#pragma once
// A window of this process's own, in a real graphics context.

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "client/view/window.h"
#include "tests/support/window_driver.h"

namespace shearwater::ui {

class GraphicsTest : public testing::Test {
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

    std::unique_ptr<test::Display> display_;
    std::unique_ptr<Window> window_;
};

}  // namespace shearwater::ui
