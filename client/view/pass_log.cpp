#include "client/view/pass_log.h"

#include <fmt/core.h>

namespace shearwater::ui {

PassLog::PassLog(const std::string& path) : path_(path) {
    if (!path_.empty()) {
        file_.open(path_);
    }
}

// A second in which nothing was shown has its line too.
void PassLog::count(bool has_new_picture) {
    if (path_.empty()) {
        return;
    }
    const auto now = std::chrono::floor<std::chrono::seconds>(Clock::now() - begin_).count();
    for (; second_ < now; ++second_) {
        file_ << fmt::format("{} {} {}\n", second_, passes_, pictures_);
        passes_ = pictures_ = 0;
        if (second_ + 1 == now) {
            file_.flush();
        }
    }
    ++passes_;
    pictures_ += has_new_picture ? 1 : 0;
}

}  // namespace shearwater::ui
