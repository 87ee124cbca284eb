#pragma once
// How often the window is drawn, second by second, in a file for whoever measures it.

#include <chrono>
#include <string>

#include "common/base/result.h"

namespace shearwater::ui {

class PassLog {
  public:
    // Lines are "SECOND PASSES PICTURES": counted from here, passes of widgets that were shown in it, and
    // pictures that were new to them. Nothing is written where the path is empty.
    explicit PassLog(std::string path) : path_(std::move(path)) {}

    // After a pass.
    base::Status count(bool has_new_picture);

  private:
    using Clock = std::chrono::steady_clock;

    const std::string path_;
    const Clock::time_point begin_ = Clock::now();
    std::string lines_;
    std::int64_t second_ = 0;
    int passes_ = 0, pictures_ = 0;
};

}  // namespace shearwater::ui
