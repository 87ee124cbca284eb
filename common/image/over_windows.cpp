#include <algorithm>

#include "common/image/over.h"

namespace shearwater::image {

namespace {

std::span<const RgbaF> row_of(const Window& window, int y) {
    return window.pixels.row(y);
}
std::span<const Rgba16> row_of(const WindowView16& window, int y) {
    const auto width = static_cast<std::size_t>(window.rect.width());
    return window.pixels.subspan(static_cast<std::size_t>(y) * width, width);
}

template <class AnyWindow>
void merge_into(Window& merged, const AnyWindow& behind) {
    const auto x = static_cast<std::size_t>(behind.rect.x0 - merged.rect.x0);
    const auto width = static_cast<std::size_t>(behind.rect.width());
    for (int y = 0; y < behind.rect.height(); ++y) {
        const auto row = merged.pixels.row(y + behind.rect.y0 - merged.rect.y0).subspan(x, width);
        over(row, row_of(behind, y));
    }
}

template <class AnyWindow>
std::vector<Window> merge(std::span<const AnyWindow> windows) {
    std::vector<Window> merged;
    const auto of_face = [&](int face) {
        return std::find_if(merged.begin(), merged.end(), [face](const Window& w) { return w.face == face; });
    };
    for (const AnyWindow& window : windows) {
        if (window.rect.empty()) {
            continue;
        }
        const auto found = of_face(window.face);
        if (found == merged.end()) {
            merged.push_back({.face = window.face, .rect = window.rect});
        } else {
            found->rect = bounding(found->rect, window.rect);
        }
    }
    for (Window& window : merged) {
        window.pixels = Image<RgbaF>(window.rect.width(), window.rect.height());
    }
    for (const AnyWindow& window : windows) {
        if (!window.rect.empty()) {
            merge_into(*of_face(window.face), window);
        }
    }
    return merged;
}

}  // namespace

std::vector<Window> merge_front_to_back(std::span<const WindowView16> windows) {
    return merge(windows);
}

std::vector<Window> merge_front_to_back(std::span<const Window> windows) {
    return merge(windows);
}

}  // namespace shearwater::image
