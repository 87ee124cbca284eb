// How a factorisation is found: the part of the picture that a face serves is a convex polygon in the
// picture's plane, cut out of its rectangle by lines, for every bound below is linear in (px, py).

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "common/view/factorisation.h"

namespace shearwater::view {

namespace {

// c + x * px + y * py over the picture.
struct Linear {
    double c, x, y;
    double at(const Vec2& p) const { return c + x * p.x + y * p.y; }
    Vec2 gradient() const { return {x, y}; }
};
Linear operator*(double k, const Linear& a) {
    return {k * a.c, k * a.x, k * a.y};
}
Linear operator-(const Linear& a, const Linear& b) {
    return {a.c - b.c, a.x - b.x, a.y - b.y};
}

using Polygon = std::vector<Vec2>;

// The part of a convex polygon where `inside` is not negative.
Polygon clip(const Polygon& polygon, const Linear& inside) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2& a = polygon[i];
        const Vec2& b = polygon[(i + 1) % polygon.size()];
        const double at_a = inside.at(a);
        const double at_b = inside.at(b);
        if (at_a >= 0) {
            kept.push_back(a);
        }
        if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) {
            kept.push_back(a + (at_a / (at_a - at_b)) * (b - a));
        }
    }
    return kept;
}

struct Interval {
    double lo = std::numeric_limits<double>::infinity();
    double hi = -std::numeric_limits<double>::infinity();
    void add(double x) {
        lo = std::min(lo, x);
        hi = std::max(hi, x);
    }
};

// One of a face's two image coordinates over the picture: numerator / denominator, the denominator
// positive wherever the face is seen.
struct Coordinate {
    Linear numerator, denominator;

    double at(const Vec2& p) const { return numerator.at(p) / denominator.at(p); }
    double slope_at(const Vec2& p) const {
        const double d = denominator.at(p);
        return glm::length(numerator.gradient() / d - (numerator.at(p) / (d * d)) * denominator.gradient());
    }
    Polygon clipped(const Polygon& polygon, const Interval& range) const {
        return clip(clip(polygon, numerator - range.lo * denominator), range.hi * denominator - numerator);
    }
};

// The change of the coordinate from one output pixel to the next: the smallest met, but no less than
// half the usual one, lest a wide picture's corner set the pitch for all of it.
double pixel_pitch(const Coordinate& coordinate, const Polygon& polygon) {
    const Vec2 middle =
        std::accumulate(polygon.begin(), polygon.end(), Vec2(0)) / static_cast<double>(polygon.size());
    double least = coordinate.slope_at(middle);
    double sum = least;
    for (const Vec2& vertex : polygon) {
        const double slope = coordinate.slope_at(vertex);
        least = std::min(least, slope);
        sum += slope;
    }
    return std::max(least, 0.5 * sum / static_cast<double>(polygon.size() + 1));
}

// A face before its pixels are counted.
struct Plan {
    Face face;
    Interval range_u, range_v;
};

// Pixels beyond the seen part on every side: the warp's filter reaches two to either side.
constexpr int margin = 2;

void lay_pixels(Plan& plan) {
    const auto along = [](const Interval& range, double pitch, double& origin) {
        origin = range.lo - margin * pitch;
        return std::ceil((range.hi - range.lo) / pitch) + 1 + 2 * margin;
    };
    Face& face = plan.face;
    const auto fit = [&](const Interval& range, double& pitch, double& origin, int& count) {
        const double room = Factorisation::max_side - 2 - 2 * margin;
        // Any pitch that can be computed with will do for a picture of no more than one point.
        pitch = std::clamp(std::max(pitch, (range.hi - range.lo) / room), 1e-29, 1e29);
        count = static_cast<int>(along(range, pitch, origin));
    };
    fit(plan.range_u, face.pitch.x, face.origin.x, face.width);
    fit(plan.range_v, face.pitch.y, face.origin.y, face.height);
}

// Gives `faces` their pixels, coarser where they would be too many together.
void lay_all(std::vector<Plan>& plans, Factorisation& factorisation) {
    const auto total = [&] {
        std::int64_t area = 0;
        for (Plan& plan : plans) {
            lay_pixels(plan);
            area += std::int64_t{plan.face.width} * plan.face.height;
        }
        return area;
    };
    while (total() > Factorisation::max_area) {
        for (Plan& plan : plans) {
            plan.face.pitch *= 1.25;
        }
    }
    for (const Plan& plan : plans) {
        factorisation.faces.push_back(plan.face);
    }
}

Polygon whole_picture(const ImageSize& size) {
    const double w = size.width;
    const double h = size.height;
    return {{0, 0}, {w, 0}, {w, h}, {0, h}};
}

void add_plan(std::vector<Plan>& plans, Face face, const Polygon& seen, const Coordinate& u,
              const Coordinate& v, double resolution) {
    if (seen.size() < 3) {
        return;
    }
    Plan plan{.face = face};
    for (const Vec2& vertex : seen) {
        plan.range_u.add(u.at(vertex));
        plan.range_v.add(v.at(vertex));
    }
    plan.face.pitch = Vec2(pixel_pitch(u, seen), pixel_pitch(v, seen)) / resolution;
    plans.push_back(plan);
}

// The slopes, as seen from the eye, of the cube's part in front of it.
Interval cube_slopes(const Factorisation& factorisation, const Face& face, const SliceRange& slices,
                     int axis) {
    Interval range;
    for (const std::int64_t k : {slices.first, slices.last}) {
        const double depth = static_cast<double>(k) - factorisation.eye[face.axis];
        range.add(-factorisation.eye[axis] / depth);
        range.add((static_cast<double>(factorisation.lattice.n[axis] - 1) - factorisation.eye[axis]) / depth);
    }
    // A slice through the eye itself has any slope.
    return {std::max(range.lo, -1.0), std::min(range.hi, 1.0)};
}

void plan_perspective(std::vector<Plan>& plans, const Factorisation& factorisation, const Rays& rays,
                      const Polygon& picture, double resolution) {
    const auto component = [&](int axis) {
        return Linear{rays.dir[axis], rays.dir_x[axis], rays.dir_y[axis]};
    };
    for (int axis = 0; axis < 3; ++axis) {
        for (const int sign : {1, -1}) {
            const Face face{.axis = axis, .sign = sign};
            const SliceRange slices =
                slices_in_front(factorisation, face, 0, factorisation.lattice.n[axis] - 1);
            if (slices.empty()) {
                continue;
            }
            const Linear forward = sign * component(axis);
            const Coordinate u{sign * component(face.u_axis()), forward};
            const Coordinate v{sign * component(face.v_axis()), forward};
            Polygon seen = u.clipped(picture, cube_slopes(factorisation, face, slices, face.u_axis()));
            seen = v.clipped(seen, cube_slopes(factorisation, face, slices, face.v_axis()));
            add_plan(plans, face, seen, u, v, resolution);
        }
    }
}

void plan_parallel(std::vector<Plan>& plans, const Factorisation& factorisation, const Rays& rays,
                   const Polygon& picture, double resolution) {
    const Vec3& direction = factorisation.direction;
    const Vec3 size = glm::abs(direction);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const Face face{.axis = axis, .sign = direction[axis] > 0 ? 1 : -1};
    const double last_slice = static_cast<double>(factorisation.lattice.n[axis] - 1);
    // Where a picture's rays cross slice 0, and where lines along them through the cube do.
    const auto coordinate = [&](int a) {
        const double shear = direction[a] / direction[axis];
        const auto on_slice_0 = [&](const Vec3& p) { return p[a] - shear * p[axis]; };
        return Coordinate{{on_slice_0(rays.origin), on_slice_0(rays.origin_x), on_slice_0(rays.origin_y)},
                          {1, 0, 0}};
    };
    const auto reach = [&](int a) {
        const double drift = direction[a] / direction[axis] * last_slice;
        Interval range;
        range.add(-std::max(drift, 0.0));
        range.add(static_cast<double>(factorisation.lattice.n[a] - 1) - std::min(drift, 0.0));
        return range;
    };
    const Coordinate u = coordinate(face.u_axis());
    const Coordinate v = coordinate(face.v_axis());
    const Polygon seen = v.clipped(u.clipped(picture, reach(face.u_axis())), reach(face.v_axis()));
    add_plan(plans, face, seen, u, v, resolution);
}

}  // namespace

Factorisation factorise(const Camera& camera, const ImageSize& size, const Lattice& lattice,
                        double resolution) {
    const Rays rays = in_voxel_space(rays_of(camera, size), lattice);
    Factorisation factorisation{.projection = camera.projection, .lattice = lattice};
    const Polygon picture = whole_picture(size);
    std::vector<Plan> plans;
    if (camera.projection == Projection::perspective) {
        factorisation.eye = rays.origin;
        factorisation.direction = lattice.voxel_direction(glm::normalize(camera.target - camera.eye));
        plan_perspective(plans, factorisation, rays, picture, resolution);
    } else {
        factorisation.direction = rays.dir;
        plan_parallel(plans, factorisation, rays, picture, resolution);
    }
    lay_all(plans, factorisation);
    return factorisation;
}

}  // namespace shearwater::view
