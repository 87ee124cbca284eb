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

// Row by row, so that a row is in the processor's cache from its first window to its last.
template <class AnyWindow>
Image<RgbaF> merge_face(int face, const Rect& rect, std::span<const AnyWindow> windows) {
    Image<RgbaF> merged(rect.width(), rect.height(), Unfilled());
    for (int y = rect.y0; y < rect.y1; ++y) {
        const std::span<RgbaF> row = merged.row(y - rect.y0);
        std::fill(row.begin(), row.end(), RgbaF{});
        for (const AnyWindow& behind : windows) {
            if (behind.face == face && !behind.rect.empty() && behind.rect.y0 <= y && y < behind.rect.y1) {
                const auto x = static_cast<std::size_t>(behind.rect.x0 - rect.x0);
                const auto pixels = row_of(behind, y - behind.rect.y0);
                over(row.subspan(x, pixels.size()), pixels);
            }
        }
    }
    return merged;
}

template <class AnyWindow>
std::vector<Window> merge(std::span<const AnyWindow> windows) {
    std::vector<Window> merged;
    for (const AnyWindow& window : windows) {
        if (window.rect.empty()) {
            continue;
        }
        const auto found = std::find_if(merged.begin(), merged.end(),
                                        [&](const Window& other) { return other.face == window.face; });
        if (found == merged.end()) {
            merged.push_back({.face = window.face, .rect = window.rect});
        } else {
            found->rect = bounding(found->rect, window.rect);
        }
    }
    for (Window& window : merged) {
        window.pixels = merge_face(window.face, window.rect, windows);
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
