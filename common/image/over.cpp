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

}  // namespace shearwater::image
