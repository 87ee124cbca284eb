#include "common/image/over.h"

#include <algorithm>

namespace shearwater::image {

namespace {

constexpr float levels = 65535.0F;

RgbaF to_float(const RgbaF& pixel) {
    return pixel;
}
RgbaF to_float(const Rgba16& pixel) {
    constexpr float unit = 1 / levels;
    return {static_cast<float>(pixel.r) * unit, static_cast<float>(pixel.g) * unit,
            static_cast<float>(pixel.b) * unit, static_cast<float>(pixel.a) * unit};
}

std::uint16_t to_level(float x) {
    return static_cast<std::uint16_t>(static_cast<int>(std::min(std::max(x, 0.0F), 1.0F) * levels + 0.5F));
}

template <class Pixel>
void over_span(std::span<RgbaF> front, std::span<const Pixel> back) {
    base::check(front.size() == back.size(), "over takes spans of one length");
    for (std::size_t i = 0; i < front.size(); ++i) {
        const RgbaF behind = to_float(back[i]);
        const float through = 1 - front[i].a;
        front[i].r += through * behind.r;
        front[i].g += through * behind.g;
        front[i].b += through * behind.b;
        front[i].a += through * behind.a;
    }
}

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
        over_span(row, row_of(behind, y));
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

void over(std::span<RgbaF> front, std::span<const RgbaF> back) {
    over_span(front, back);
}

void over(std::span<RgbaF> front, std::span<const Rgba16> back) {
    over_span(front, back);
}

void to_16_bits(std::span<const RgbaF> from, std::span<Rgba16> to) {
    base::check(from.size() == to.size(), "pixels are converted one to one");
    for (std::size_t i = 0; i < from.size(); ++i) {
        to[i] = {to_level(from[i].r), to_level(from[i].g), to_level(from[i].b), to_level(from[i].a)};
    }
}

void from_16_bits(std::span<const Rgba16> from, std::span<RgbaF> to) {
    base::check(from.size() == to.size(), "pixels are converted one to one");
    for (std::size_t i = 0; i < from.size(); ++i) {
        to[i] = to_float(from[i]);
    }
}

std::vector<Window> merge_front_to_back(std::span<const WindowView16> windows) {
    return merge(windows);
}

std::vector<Window> merge_front_to_back(std::span<const Window> windows) {
    return merge(windows);
}

}  // namespace shearwater::image
