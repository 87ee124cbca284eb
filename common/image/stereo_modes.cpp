#include "common/image/stereo_modes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/base/check.h"

namespace shearwater::image {

namespace {

double light_of(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}
double code_of(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

// Between codes of 8 bits and the light that they stand for, 0 to 1.
class Light {
  public:
    Light() : codes_(steps + 1) {
        for (std::size_t code = 0; code < of_.size(); ++code) {
            of_[code] = static_cast<float>(light_of(static_cast<double>(code) / 255));
        }
        for (std::size_t n = 0; n < codes_.size(); ++n) {
            const double light = static_cast<double>(n) / steps;
            codes_[n] = static_cast<std::uint8_t>(std::lround(255 * code_of(light)));
        }
    }
    float of(std::uint8_t code) const { return of_[code]; }
    std::uint8_t code(float light) const {
        return codes_[static_cast<std::size_t>(std::clamp(light, 0.0F, 1.0F) * steps + 0.5F)];
    }

  private:
    static constexpr int steps = 1 << 14;  // finer than the darkest codes are apart
    std::array<float, 256> of_;
    std::vector<std::uint8_t> codes_;
};

// What of the left eye's red, green and blue light, and then of the right one's, goes into each channel. Of
// glasses as they are sold, before a liquid crystal display.
using Weights = std::array<float, 6>;
constexpr Weights red{0.437F, 0.449F, 0.164F, -0.011F, -0.032F, -0.007F};
constexpr Weights green{-0.062F, -0.062F, -0.024F, 0.377F, 0.761F, 0.009F};
constexpr Weights blue{-0.048F, -0.050F, -0.017F, -0.026F, -0.093F, 1.234F};

Image<Rgba8> anaglyph(const Image<Rgba8>& left, const Image<Rgba8>& right) {
    const Light light;
    Image<Rgba8> out(left.width(), left.height(), Unfilled());
    for (std::size_t n = 0; n < out.pixels().size(); ++n) {
        const Rgba8 &l = left.pixels()[n], &r = right.pixels()[n];
        const std::array<float, 6> seen{light.of(l.r), light.of(l.g), light.of(l.b),
                                        light.of(r.r), light.of(r.g), light.of(r.b)};
        const auto channel = [&](const Weights& weights) {
            float sum = 0;
            for (std::size_t i = 0; i < seen.size(); ++i) {
                sum += weights[i] * seen[i];
            }
            return light.code(sum);
        };
        out.pixels()[n] = {channel(red), channel(green), channel(blue), std::max(l.a, r.a)};
    }
    return out;
}

}  // namespace

std::optional<StereoMode> stereo_mode(std::string_view name) {
    const auto found = std::ranges::find(stereo_mode_names, name);
    if (found == stereo_mode_names.end()) {
        return std::nullopt;
    }
    return static_cast<StereoMode>(found - stereo_mode_names.begin());
}

view::ImageSize composed_size(const view::ImageSize& eye, StereoMode mode) {
    return {mode == StereoMode::side_by_side || is_apart(mode) ? 2 * eye.width : eye.width,
            mode == StereoMode::top_bottom ? 2 * eye.height : eye.height};
}

Image<Rgba8> composed(const Image<Rgba8>& left, const Image<Rgba8>& right, StereoMode mode) {
    base::check(left.width() == right.width() && left.height() == right.height(), "both eyes see as much");
    if (mode == StereoMode::anaglyph) {
        return anaglyph(left, right);
    }
    const view::ImageSize size = composed_size({left.width(), left.height()}, mode);
    Image<Rgba8> out(size.width, size.height, Unfilled());
    for (int y = 0; y < left.height(); ++y) {
        const auto put = [&](const Image<Rgba8>& eye, int x, int row) {
            std::ranges::copy(eye.row(y), out.row(row).begin() + x);
        };
        switch (mode) {
            case StereoMode::side_by_side:
            case StereoMode::quad_buffered:
            case StereoMode::two_windows:
                put(left, 0, y);
                put(right, left.width(), y);
                break;
            case StereoMode::top_bottom:
                put(left, 0, y);
                put(right, 0, left.height() + y);
                break;
            case StereoMode::interlaced:
                put(y % 2 == 0 ? left : right, 0, y);
                break;
            default:
                put(mode == StereoMode::left ? left : right, 0, y);
                break;
        }
    }
    return out;
}

}  // namespace shearwater::image
