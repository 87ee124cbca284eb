#include "common/image/warp.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace shearwater::image {

namespace {

using view::Face;
using view::Factorisation;
using view::Projection;
using view::Vec3;

// Where a ray of the picture lies in the intermediate images; window is null where none has it.
struct Place {
    const Window* window = nullptr;
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
            by_face_[slot(face.axis, face.sign > 0)] = &window;
        }
    }

    Place find(double px, double py) const {
        const bool perspective = factorisation_.projection == Projection::perspective;
        const Vec3 direction = perspective ? rays_.direction_at(px, py) : factorisation_.direction;
        const int axis = principal_axis(direction);
        const Window* const window = by_face_[slot(axis, direction[axis] > 0)];
        if (window == nullptr) {
            return {};
        }
        const Face& face = factorisation_.faces[static_cast<std::size_t>(window->face)];
        const int u = face.u_axis();
        const int v = face.v_axis();
        double at_u = direction[u] / direction[axis];
        double at_v = direction[v] / direction[axis];
        if (!perspective) {
            const Vec3 origin = rays_.origin_at(px, py);
            at_u = origin[u] - at_u * origin[axis];
            at_v = origin[v] - at_v * origin[axis];
        }
        return {window, (at_u - face.origin.x) / face.pitch.x, (at_v - face.origin.y) / face.pitch.y};
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
    std::array<const Window*, Factorisation::max_faces> by_face_{};
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

RgbaF resample(const Window& window, double i, double j) {
    const double x = i - window.rect.x0;
    const double y = j - window.rect.y0;
    const int width = window.rect.width();
    const int height = window.rect.height();
    if (!(x > -2 && y > -2 && x < width + 1 && y < height + 1)) {
        return {};
    }
    const int x0 = static_cast<int>(std::floor(x));
    const int y0 = static_cast<int>(std::floor(y));
    const auto weight_x = cubic_weights(static_cast<float>(x - x0));
    const auto weight_y = cubic_weights(static_cast<float>(y - y0));
    RgbaF sum;
    for (int dy = 0; dy < 4; ++dy) {
        const int row = y0 - 1 + dy;
        if (row < 0 || row >= height) {
            continue;
        }
        const auto pixels = window.pixels.row(row);
        RgbaF along;
        for (int dx = 0; dx < 4; ++dx) {
            const int column = x0 - 1 + dx;
            if (column >= 0 && column < width) {
                along += weight_x[static_cast<std::size_t>(dx)] * pixels[static_cast<std::size_t>(column)];
            }
        }
        sum += weight_y[static_cast<std::size_t>(dy)] * along;
    }
    return within_gamut(sum);
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
            pixels[static_cast<std::size_t>(x)] =
                finish(place.window == nullptr ? RgbaF{} : resample(*place.window, place.i, place.j));
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
