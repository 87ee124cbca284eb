#pragma once
// How often the window is drawn, second by second, in a file for whoever measures it.

#include <chrono>
#include <string>

#include "common/base/result.h"

namespace shearwater::ui {

class PassLog {
  public:
    // Lines are "SECOND PASSES DRAWN PICTURES": counted from here, passes of widgets in it, those that looked
    // other than the one before and were drawn, and pictures that were new to them. Nothing is written where
    // the path is empty.
    explicit PassLog(std::string path) : path_(std::move(path)) {}

    struct Pass {
        bool drawn, has_new_picture;
    };
    base::Status count(const Pass& pass);

  private:
    using Clock = std::chrono::steady_clock;

    const std::string path_;
    const Clock::time_point begin_ = Clock::now();
    std::string lines_;
    std::int64_t second_ = 0;
    int passes_ = 0, drawn_ = 0, pictures_ = 0;
};

}  // namespace shearwater::ui
