#include "tests/support/reference_raycaster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shearwater::test {

namespace {

using view::Vec3;

constexpr double infinity = std::numeric_limits<double>::infinity();

// A stretch of ray parameters, and the faces it comes in and goes out by.
struct Stretch {
    double a = 0, b = 0;
    int in = -1, out = -1;
};

// Where origin + t * direction is inside the box from 0 to last, t from `begin` on.
Stretch inside(const Vec3& origin, const Vec3& direction, const Vec3& last, double begin) {
    Stretch t{begin, infinity};
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0) {
            if (origin[axis] < 0 || origin[axis] > last[axis]) {
                return {};
            }
            continue;
        }
        const bool rising = direction[axis] > 0;
        const double enter = ((rising ? 0 : last[axis]) - origin[axis]) / direction[axis];
        const double leave = ((rising ? last[axis] : 0) - origin[axis]) / direction[axis];
        if (enter > t.a) {
            t.a = enter;
            t.in = 2 * axis + (rising ? 0 : 1);
        }
        if (leave < t.b) {
            t.b = leave;
            t.out = 2 * axis + (rising ? 1 : 0);
        }
    }
    return t.b > t.a ? t : Stretch{};
}

Vec3 last_of(const volume::Index3& n) {
    return {static_cast<double>(n[0] - 1), static_cast<double>(n[1] - 1), static_cast<double>(n[2] - 1)};
}

struct Ray {
    Vec3 origin, direction;  // voxel space
    Stretch t;
    double world_per_t;
};

Ray ray_of(const view::Rays& rays, const volume::Index3& n, const Vec3& spacing, double px, double py) {
    Ray ray{.origin = rays.origin_at(px, py), .direction = rays.direction_at(px, py)};
    const double begin = rays.projection == view::Projection::perspective ? 0 : -infinity;
    ray.t = inside(ray.origin, ray.direction, last_of(n), begin);
    ray.world_per_t = glm::length(ray.direction * spacing);
    return ray;
}

// s at a point of the cube; negative where it is blank.
double sample(const volume::Index3& n, const std::vector<float>& s, const Vec3& p) {
    std::int64_t cell[3];
    double f[3];
    for (int axis = 0; axis < 3; ++axis) {
        cell[axis] = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(p[axis])), 0,
                                              n[static_cast<std::size_t>(axis)] - 2);
        f[axis] = std::clamp(p[axis] - static_cast<double>(cell[axis]), 0.0, 1.0);
    }
    double sum = 0;
    double valid = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const int dx = corner & 1, dy = (corner >> 1) & 1, dz = corner >> 2;
        const double weight = (dx ? f[0] : 1 - f[0]) * (dy ? f[1] : 1 - f[1]) * (dz ? f[2] : 1 - f[2]);
        const float value =
            s[static_cast<std::size_t>(((cell[2] + dz) * n[1] + cell[1] + dy) * n[0] + cell[0] + dx)];
        if (!std::isnan(value)) {
            sum += weight * static_cast<double>(value);
            valid += weight;
        }
    }
    return valid < 0.5 ? -1 : sum / valid;
}

template <class Pixel, class Error>
double psnr_of(const image::Image<Pixel>& a, const image::Image<Pixel>& b, double channels,
               const Error& squares) {
    base::check(a.width() == b.width() && a.height() == b.height(), "pictures of one size");
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        sum += squares(a.pixels()[i], b.pixels()[i]);
    }
    return sum > 0 ? -10 * std::log10(sum / (channels * static_cast<double>(a.pixels().size()))) : 200;
}

double square(double x) {
    return x * x;
}

}  // namespace

image::Image<image::RgbaF> cast_rays(const FloatCube& cube, const Vec3& spacing,
                                     const volume::Mapping& mapping, const view::TransferFunction& tf,
                                     const view::Camera& camera, const view::ImageSize& size,
                                     base::Workers& workers, double piece) {
    std::vector<float> s = cube.values();
    for (float& value : s) {
        value = std::isfinite(value) ? static_cast<float>(mapping.stretched(static_cast<double>(value)))
                                     : std::numeric_limits<float>::quiet_NaN();
    }
    // Evaluating pins is slow and shows nothing of the engine: done once on a grid too fine to matter.
    constexpr int fine = 1 << 16;
    std::vector<double> extinction(fine + 1);
    std::vector<view::Rgb> colour(fine + 1);
    for (int i = 0; i <= fine; ++i) {
        extinction[static_cast<std::size_t>(i)] = tf.extinction(static_cast<double>(i) / fine);
        colour[static_cast<std::size_t>(i)] = tf.colour(static_cast<double>(i) / fine);
    }
    const view::Lattice lattice{cube.n(), spacing};
    const view::Rays rays = in_voxel_space(view::rays_of(camera, size), lattice);
    image::Image<image::RgbaF> picture(size.width, size.height);
    workers.for_each(size.height, [&](std::int64_t row) {
        for (int x = 0; x < size.width; ++x) {
            const Ray ray = ray_of(rays, cube.n(), spacing, x + 0.5, static_cast<double>(row) + 0.5);
            const double voxels = (ray.t.b - ray.t.a) * glm::length(ray.direction);
            const auto pieces = static_cast<std::int64_t>(std::ceil(voxels / piece));
            double r = 0, g = 0, b = 0, through = 1;
            for (std::int64_t n = 0; n < pieces; ++n) {
                const double dt = (ray.t.b - ray.t.a) / static_cast<double>(pieces);
                const Vec3 p = ray.origin + (ray.t.a + (static_cast<double>(n) + 0.5) * dt) * ray.direction;
                const double at = sample(cube.n(), s, p);
                if (at < 0) {
                    continue;
                }
                const auto entry = static_cast<std::size_t>(std::lround(std::min(at, 1.0) * fine));
                const double alpha = -std::expm1(-extinction[entry] * dt * ray.world_per_t);
                r += through * alpha * colour[entry].r;
                g += through * alpha * colour[entry].g;
                b += through * alpha * colour[entry].b;
                through *= 1 - alpha;
            }
            picture.at(x, static_cast<int>(row)) = {static_cast<float>(r), static_cast<float>(g),
                                                    static_cast<float>(b), static_cast<float>(1 - through)};
        }
    });
    return picture;
}

Chord chord_of(const volume::Index3& n, const Vec3& spacing, const Vec3& origin, const Vec3& direction,
               bool begins) {
    const Stretch t = inside(origin, direction, last_of(n), begins ? 0 : -infinity);
    const Vec3 along = glm::abs(direction);
    return {(t.b - t.a) * glm::length(direction * spacing),
            (t.b - t.a) * std::max({along.x, along.y, along.z}), t.in, t.out};
}

Chord chord_of(const volume::Index3& n, const Vec3& spacing, const view::Camera& camera,
               const view::ImageSize& size, double px, double py) {
    const view::Rays rays = in_voxel_space(view::rays_of(camera, size), {n, spacing});
    return chord_of(n, spacing, rays.origin_at(px, py), rays.direction_at(px, py),
                    rays.projection == view::Projection::perspective);
}

double psnr(const image::Image<image::RgbaF>& a, const image::Image<image::RgbaF>& b) {
    return psnr_of(a, b, 4, [](const image::RgbaF& p, const image::RgbaF& q) {
        return square(p.r - q.r) + square(p.g - q.g) + square(p.b - q.b) + square(p.a - q.a);
    });
}

double psnr(const image::Image<image::Rgba8>& a, const image::Image<image::Rgba8>& b) {
    return psnr_of(a, b, 3, [](const image::Rgba8& p, const image::Rgba8& q) {
        return (square(p.r - q.r) + square(p.g - q.g) + square(p.b - q.b)) / (255.0 * 255.0);
    });
}

int largest_difference(const image::Image<image::Rgba8>& a, const image::Image<image::Rgba8>& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const image::Rgba8& p = a.pixels()[i];
        const image::Rgba8& q = b.pixels()[i];
        largest = std::max({largest, std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)});
    }
    return largest;
}

}  // namespace shearwater::test
