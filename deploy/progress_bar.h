#pragma once
// Progress of long work on standard error, where that is a terminal.

#include <chrono>
#include <string>

namespace shearwater::deploy {

class ProgressBar {
  public:
    explicit ProgressBar(std::string what);
    ~ProgressBar();  // takes the bar away
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    // At most ten times a second on the screen.
    void show(double fraction);

  private:
    std::string what_;
    bool terminal_;
    bool shown_ = false;
    std::chrono::steady_clock::time_point last_{};
};

}  // namespace shearwater::deploy
