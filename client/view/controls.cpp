#include "client/view/controls.h"

#include <fmt/format.h>

#include <cmath>

#include "common/base/text_file.h"

namespace shearwater::ui {

void Controls::note(const std::string& name) {
    const ImVec2 from = ImGui::GetItemRectMin();
    const ImVec2 size = ImGui::GetItemRectSize();
    if (ImGui::IsItemVisible()) {
        seen_[name] = {static_cast<int>(from.x), static_cast<int>(from.y), static_cast<int>(size.x),
                       static_cast<int>(size.y)};
    }
}

void Controls::note(const std::string& name, ImVec2 middle) {
    seen_[name] = {static_cast<int>(std::lround(middle.x)), static_cast<int>(std::lround(middle.y)), 0, 0};
}

base::Status Controls::write(const std::string& path) {
    if (seen_ == written_) {
        return {};
    }
    written_ = seen_;
    std::string text;
    for (const auto& [name, place] : written_) {
        text += fmt::format("{} {} {} {} {}\n", name, place.x, place.y, place.width, place.height);
    }
    return base::write_text_file(path, text);
}

}  // namespace shearwater::ui
