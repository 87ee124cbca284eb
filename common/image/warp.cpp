#include "common/image/warp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/image/silhouette.h"

namespace shearwater::image {

namespace {

using view::Face;
using view::Factorisation;
using view::Projection;
using view::Vec3;

// A face's intermediate image, and what of it the cube covers.
struct Layer {
    const Window* window;
    const Face* face;
    Silhouette silhouette;
};

// Where a ray of the picture lies in the intermediate images; layer is null where none has it.
struct Place {
    const Layer* layer = nullptr;
    double i = 0, j = 0;  // in the face's pixels
};

class Finder {
  public:
    Finder(const Factorisation& factorisation, std::span<const Window> windows, const view::Camera& camera,
           const view::ImageSize& size)
        : factorisation_(factorisation),
          rays_(in_voxel_space(view::rays_of(camera, size), factorisation.lattice)) {
        for (const Window& window : windows) {
            const Face& face = factorisation.faces[static_cast<std::size_t>(window.face)];
            layers_[slot(face.axis, face.sign > 0)].emplace(
                Layer{&window, &face, Silhouette(factorisation, face)});
        }
    }

    Place find(double px, double py) const {
        const bool perspective = factorisation_.projection == Projection::perspective;
        const Vec3 direction = perspective ? rays_.direction_at(px, py) : factorisation_.direction;
        const int axis = principal_axis(direction);
        const std::optional<Layer>& layer = layers_[slot(axis, direction[axis] > 0)];
        if (!layer) {
            return {};
        }
        const Face& face = *layer->face;
        const int u = face.u_axis();
        const int v = face.v_axis();
        double at_u = direction[u] / direction[axis];
        double at_v = direction[v] / direction[axis];
        if (!perspective) {
            const Vec3 origin = rays_.origin_at(px, py);
            at_u = origin[u] - at_u * origin[axis];
            at_v = origin[v] - at_v * origin[axis];
        }
        return {&*layer, (at_u - face.origin.x) / face.pitch.x, (at_v - face.origin.y) / face.pitch.y};
    }

  private:
    static std::size_t slot(int axis, bool rising) {
        return static_cast<std::size_t>(2 * axis + (rising ? 1 : 0));
    }

    static int principal_axis(const Vec3& direction) {
        const Vec3 size = glm::abs(direction);
        return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    }

    const Factorisation& factorisation_;
    view::Rays rays_;
    std::array<std::optional<Layer>, Factorisation::max_faces> layers_;
};

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
        if (!layer.silhouette.pixel_row(j).contains(i)) {
            continue;
        }
        const float x = static_cast<float>(n % 4 - 1) - patch.tx;
        const float y = static_cast<float>(n / 4 - 1) - patch.ty;
        const float tent = std::max(2 - std::abs(x), 0.05F) * std::max(2 - std::abs(y), 0.05F);
        const float w = tent * tent;
        taps[count++] = {w, x, y, pixel_at(*layer.window, i, j)};
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

RgbaF resample(const Place& place) {
    const Layer& layer = *place.layer;
    const int rows = layer.face->height;
    if (!(place.i > -1 && place.j > -1 && place.i < layer.face->width && place.j < rows)) {
        return {};
    }
    const double i = std::floor(place.i);
    const double j = std::floor(place.j);
    const Patch patch{static_cast<int>(i) - 1, static_cast<int>(j) - 1, static_cast<float>(place.i - i),
                      static_cast<float>(place.j - j)};
    // The outline is convex: it holds the patch if it holds its corners.
    const Stretch& top = layer.silhouette.pixel_row(patch.j);
    const Stretch& bottom = layer.silhouette.pixel_row(patch.j + 3);
    if (std::max(top.lo, bottom.lo) <= patch.i && patch.i + 3 <= std::min(top.hi, bottom.hi)) {
        return interpolate(*layer.window, patch);
    }
    return layer.silhouette.row(place.j).contains(place.i) ? extrapolate(layer, patch) : RgbaF{};
}

std::uint8_t to_level(double x) {
    return static_cast<std::uint8_t>(std::clamp(x, 0.0, 1.0) * 255 + 0.5);
}

template <class Pixel, class Finish>
Image<Pixel> warp_to(const Factorisation& factorisation, std::span<const Window> windows,
                     const view::Camera& camera, const view::ImageSize& size, base::Workers& workers,
                     const Finish& finish) {
    Image<Pixel> picture(size.width, size.height);
    const Finder finder(factorisation, windows, camera, size);
    workers.for_each(size.height, [&](std::int64_t row) {
        const int y = static_cast<int>(row);
        const auto pixels = picture.row(y);
        for (int x = 0; x < size.width; ++x) {
            const Place place = finder.find(x + 0.5, y + 0.5);
            pixels[static_cast<std::size_t>(x)] = finish(place.layer == nullptr ? RgbaF{} : resample(place));
        }
    });
    return picture;
}

}  // namespace

Image<Rgba8> warp(const Factorisation& factorisation, std::span<const Window> windows,
                  const view::Camera& camera, const view::ImageSize& size, const view::Rgb& background,
                  base::Workers& workers) {
    return warp_to<Rgba8>(factorisation, windows, camera, size, workers, [&](const RgbaF& pixel) {
        const double through = 1 - static_cast<double>(pixel.a);
        return Rgba8{to_level(pixel.r + through * background.r), to_level(pixel.g + through * background.g),
                     to_level(pixel.b + through * background.b), 255};
    });
}

Image<RgbaF> warp_float(const Factorisation& factorisation, std::span<const Window> windows,
                        const view::Camera& camera, const view::ImageSize& size, base::Workers& workers) {
    return warp_to<RgbaF>(factorisation, windows, camera, size, workers,
                          [](const RgbaF& pixel) { return pixel; });
}

}  // namespace shearwater::image
