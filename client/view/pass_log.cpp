#include "client/view/pass_log.h"

#include <fmt/core.h>

#include "common/base/text_file.h"

namespace shearwater::ui {

// A second without a pass has its line too.
base::Status PassLog::count(const Pass& pass) {
    if (path_.empty()) {
        return {};
    }
    const auto now = std::chrono::floor<std::chrono::seconds>(Clock::now() - begin_).count();
    const bool is_another = second_ < now;
    for (; second_ < now; ++second_) {
        lines_ += fmt::format("{} {} {} {}\n", second_, passes_, drawn_, pictures_);
        passes_ = drawn_ = pictures_ = 0;
    }
    ++passes_;
    drawn_ += pass.drawn ? 1 : 0;
    pictures_ += pass.has_new_picture ? 1 : 0;
    return is_another ? base::write_text_file(path_, lines_) : base::Status();
}

}  // namespace shearwater::ui
