#include "deploy/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace shearwater::deploy {

ProgressBar::ProgressBar(std::string what) : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
    if (shown_) {
        std::fprintf(stderr, "\r\033[K");
    }
}

void ProgressBar::show(double fraction) {
    const auto now = std::chrono::steady_clock::now();
    if (!terminal_ || (shown_ && now - last_ < std::chrono::milliseconds(100))) {
        return;
    }
    last_ = now;
    shown_ = true;
    constexpr int width = 40;
    const double share = std::clamp(fraction, 0.0, 1.0);
    const int filled = static_cast<int>(share * width);
    std::fprintf(stderr, "\r%s [%s%s] %3d %%", what_.c_str(), std::string(filled, '#').c_str(),
                 std::string(width - filled, ' ').c_str(), static_cast<int>(100 * share));
}

}  // namespace shearwater::deploy
