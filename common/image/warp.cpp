#include "common/image/warp.h"

#include <algorithm>
#include <array>
#include <optional>

#include "common/image/finish.h"
#include "common/image/layer.h"
#include "common/image/resample_span.h"

namespace shearwater::image {

namespace {

using view::Face;
using view::Factorisation;
using view::Projection;
using view::Vec3;

// The faces' images, and which of them a point of the picture is in. Faces are numbered as the sides of the
// cube around the eye that the rays go through.
class Finder {
  public:
    Finder(const Factorisation& factorisation, std::span<const Window> windows, const view::Camera& camera,
           const view::ImageSize& size, base::Workers& workers)
        : factorisation_(factorisation),
          rays_(in_voxel_space(view::rays_of(camera, size), factorisation.lattice)),
          width_(size.width) {
        for (const Window& window : windows) {
            const Face& face = factorisation.faces[static_cast<std::size_t>(window.face)];
            layers_[side(face.axis, face.sign > 0)].emplace(factorisation, window, workers);
        }
    }

    std::size_t side_at(double px, double py) const {
        const Vec3 direction = perspective() ? rays_.direction_at(px, py) : factorisation_.direction;
        const int axis = principal_axis(direction);
        return side(axis, direction[axis] > 0);
    }

    // The end of the pixels of row y, from x on, that are in the side of x. A side's rays are a convex cone,
    // so that the row goes through each in one stretch.
    int end_of_side(int x, int y) const {
        const std::size_t here = side_at(x + 0.5, y + 0.5);
        int last = x, end = width_;
        for (int at = end - 1; last + 1 < end; at = last + (end - last) / 2) {
            (side_at(at + 0.5, y + 0.5) == here ? last : end) = at;
            if (last == width_ - 1) {
                return width_;
            }
        }
        return end;
    }

    // Null where there is none, or nothing in it.
    const Layer* layer(std::size_t side) const {
        return layers_[side] && !layers_[side]->lit().empty() ? &*layers_[side] : nullptr;
    }

    // Of a row of points whose rays go through the layer's face.
    Track track(const Layer& layer, double py) const {
        const Face& face = layer.face();
        const int u = face.u_axis(), v = face.v_axis(), w = face.axis;
        if (perspective()) {
            const Vec3 start = rays_.direction_at(0, py);
            const Vec3& step = rays_.dir_x;
            return {(start[u] - face.origin.x * start[w]) / face.pitch.x,
                    (step[u] - face.origin.x * step[w]) / face.pitch.x,
                    (start[v] - face.origin.y * start[w]) / face.pitch.y,
                    (step[v] - face.origin.y * step[w]) / face.pitch.y,
                    start[w],
                    step[w]};
        }
        const Vec3 slope = factorisation_.direction / factorisation_.direction[w];
        const Vec3 start = rays_.origin_at(0, py) - slope * rays_.origin_at(0, py)[w];
        const Vec3 step = rays_.origin_x - slope * rays_.origin_x[w];
        return {(start[u] - face.origin.x) / face.pitch.x, step[u] / face.pitch.x,
                (start[v] - face.origin.y) / face.pitch.y, step[v] / face.pitch.y};
    }

  private:
    bool perspective() const { return factorisation_.projection == Projection::perspective; }

    static std::size_t side(int axis, bool rising) {
        return static_cast<std::size_t>(2 * axis + (rising ? 1 : 0));
    }

    static int principal_axis(const Vec3& direction) {
        const Vec3 size = glm::abs(direction);
        return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    }

    const Factorisation& factorisation_;
    view::Rays rays_;
    int width_;
    std::array<std::optional<Layer>, Factorisation::max_faces> layers_;
};

// Row y of the picture into `row`, transparent before. `left` is room for a row's numbers.
void warp_row(const Finder& finder, int y, std::span<RgbaF> row, std::span<int> left) {
    const int width = static_cast<int>(row.size());
    for (int x = 0, end = 0; x < width; x = end) {
        end = finder.end_of_side(x, y);
        const Layer* const layer = finder.layer(finder.side_at(x + 0.5, y + 0.5));
        if (layer == nullptr) {
            continue;
        }
        const auto part = row.subspan(static_cast<std::size_t>(x), static_cast<std::size_t>(end - x));
        const Track track = finder.track(*layer, y + 0.5);
        const std::size_t count = resample_span(*layer, track, x, part, left);
        for (const int n : left.first(count)) {
            part[static_cast<std::size_t>(n)] = resample(*layer, track.at(x + n + 0.5));
        }
    }
}

// Calls body(y, left) for every row.
template <class Body>
void for_each_row(const view::ImageSize& size, base::Workers& workers, const Body& body) {
    constexpr int rows_at_a_time = 4;
    workers.for_each((size.height + rows_at_a_time - 1) / rows_at_a_time, [&](std::int64_t part) {
        std::vector<int> left(static_cast<std::size_t>(size.width));
        const int begin = static_cast<int>(part) * rows_at_a_time;
        for (int y = begin; y < std::min(begin + rows_at_a_time, size.height); ++y) {
            body(y, left);
        }
    });
}

}  // namespace

Image<Rgba8> warp(const Factorisation& factorisation, std::span<const Window> windows,
                  const view::Camera& camera, const view::ImageSize& size, const view::Rgb& background,
                  base::Workers& workers) {
    Image<Rgba8> picture(size.width, size.height, Unfilled());
    const Finder finder(factorisation, windows, camera, size, workers);
    for_each_row(size, workers, [&](int y, std::span<int> left) {
        std::vector<RgbaF> row(static_cast<std::size_t>(size.width));
        warp_row(finder, y, row, left);
        finish(row, background, picture.row(y));
    });
    return picture;
}

Image<RgbaF> warp_float(const Factorisation& factorisation, std::span<const Window> windows,
                        const view::Camera& camera, const view::ImageSize& size, base::Workers& workers) {
    Image<RgbaF> picture(size.width, size.height);
    const Finder finder(factorisation, windows, camera, size, workers);
    for_each_row(size, workers,
                 [&](int y, std::span<int> left) { warp_row(finder, y, picture.row(y), left); });
    return picture;
}

}  // namespace shearwater::image
