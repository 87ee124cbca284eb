#include "common/image/resample.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace shearwater::image {

namespace {

RgbaF& operator+=(RgbaF& sum, const RgbaF& pixel) {
    sum = {sum.r + pixel.r, sum.g + pixel.g, sum.b + pixel.b, sum.a + pixel.a};
    return sum;
}
RgbaF operator*(float k, const RgbaF& pixel) {
    return {k * pixel.r, k * pixel.g, k * pixel.b, k * pixel.a};
}

// Catmull-Rom's weights of the four pixels about a point, t of the way from the second to the third.
std::array<float, 4> cubic_weights(float t) {
    return {0.5F * t * (-1 + t * (2 - t)), 0.5F * (2 + t * t * (-5 + 3 * t)),
            0.5F * t * (1 + t * (4 - 3 * t)), 0.5F * t * t * (-1 + t)};
}

RgbaF within_gamut(const RgbaF& pixel) {
    const float a = std::clamp(pixel.a, 0.0F, 1.0F);
    return {std::clamp(pixel.r, 0.0F, a), std::clamp(pixel.g, 0.0F, a), std::clamp(pixel.b, 0.0F, a), a};
}

// A pixel's neighbourhood: the 4 x 4 intermediate pixels about its place, which lies (tx, ty) of the way
// from the second to the third of them.
struct Patch {
    int i, j;  // of the first, in the face's pixels
    float tx, ty;
};

RgbaF pixel_at(const Window& window, int i, int j) {
    const Rect& rect = window.rect;
    const bool has = rect.x0 <= i && i < rect.x1 && rect.y0 <= j && j < rect.y1;
    return has ? window.pixels.at(i - rect.x0, j - rect.y0) : RgbaF{};
}

// Catmull-Rom's cubic interpolation.
RgbaF interpolate(const Window& window, const Patch& patch) {
    const auto weight_x = cubic_weights(patch.tx);
    const auto weight_y = cubic_weights(patch.ty);
    const Rect& rect = window.rect;
    const bool whole =
        patch.i >= rect.x0 && patch.i + 4 <= rect.x1 && patch.j >= rect.y0 && patch.j + 4 <= rect.y1;
    RgbaF sum;
    for (int dy = 0; dy < 4; ++dy) {
        RgbaF along;
        const RgbaF* const row =
            whole ? &window.pixels.at(patch.i - rect.x0, patch.j + dy - rect.y0) : nullptr;
        for (int dx = 0; dx < 4; ++dx) {
            along += weight_x[static_cast<std::size_t>(dx)] *
                     (whole ? row[dx] : pixel_at(window, patch.i + dx, patch.j + dy));
        }
        sum += weight_y[static_cast<std::size_t>(dy)] * along;
    }
    return within_gamut(sum);
}

// Beside the silhouette, where some of the neighbourhood has no value: the plane that fits the rest best,
// so that the picture ends as sharply as the cube does, at the place where it does.
RgbaF extrapolate(const Layer& layer, const Patch& patch) {
    struct Tap {
        float weight, x, y;
        RgbaF pixel;
    };
    std::array<Tap, 16> taps;
    std::size_t count = 0;
    float s = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
    for (int n = 0; n < 16; ++n) {
        const int i = patch.i + n % 4;
        const int j = patch.j + n / 4;
        if (!layer.silhouette().pixel_row(j).contains(i)) {
            continue;
        }
        const float x = static_cast<float>(n % 4 - 1) - patch.tx;
        const float y = static_cast<float>(n / 4 - 1) - patch.ty;
        const float tent = std::max(2 - std::abs(x), 0.05F) * std::max(2 - std::abs(y), 0.05F);
        const float w = tent * tent;
        taps[count++] = {w, x, y, pixel_at(layer.window(), i, j)};
        s += w;
        sx += w * x;
        sy += w * y;
        sxx += w * x * x;
        sxy += w * x * y;
        syy += w * y * y;
    }
    if (count == 0) {
        return {};
    }
    // The fitted plane's value here is the sum of weight * (a + b x + c y) * pixel.
    const float determinant =
        s * (sxx * syy - sxy * sxy) - sx * (sx * syy - sxy * sy) + sy * (sx * sxy - sxx * sy);
    float a = 1 / s, b = 0, c = 0;
    if (determinant > 0.02F * s * s * s) {
        a = (sxx * syy - sxy * sxy) / determinant;
        b = (sxy * sy - sx * syy) / determinant;
        c = (sx * sxy - sxx * sy) / determinant;
    }
    RgbaF sum;
    for (const Tap& tap : std::span(taps).first(count)) {
        sum += tap.weight * (a + b * tap.x + c * tap.y) * tap.pixel;
    }
    return within_gamut(sum);
}

}  // namespace

RgbaF resample(const Layer& layer, const Place& place) {
    const view::Face& face = layer.face();
    if (!(place.i > -1 && place.j > -1 && place.i < face.width && place.j < face.height)) {
        return {};
    }
    const double i = std::floor(place.i);
    const double j = std::floor(place.j);
    const Patch patch{static_cast<int>(i) - 1, static_cast<int>(j) - 1, static_cast<float>(place.i - i),
                      static_cast<float>(place.j - j)};
    // The outline is convex: it holds the patch if it holds its corners.
    const Stretch& top = layer.silhouette().pixel_row(patch.j);
    const Stretch& bottom = layer.silhouette().pixel_row(patch.j + 3);
    if (std::max(top.lo, bottom.lo) <= patch.i && patch.i + 3 <= std::min(top.hi, bottom.hi)) {
        return interpolate(layer.window(), patch);
    }
    return layer.silhouette().contains(place.i, place.j) ? extrapolate(layer, patch) : RgbaF{};
}

}  // namespace shearwater::image
