// How a factorisation is found: the part of the picture that a face serves is a convex polygon in the
// picture's plane, cut out of its rectangle by lines, for every bound below is linear in (px, py).

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "common/view/factorisation.h"
#include "common/volume/levels.h"

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

// Points all over a convex polygon: its vertices, and some between each two of them and the middle.
Polygon strewn(const Polygon& polygon) {
    const Vec2 middle =
        std::accumulate(polygon.begin(), polygon.end(), Vec2(0)) / static_cast<double>(polygon.size());
    Polygon points{middle};
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2& a = polygon[i];
        const Vec2& b = polygon[(i + 1) % polygon.size()];
        for (const double out : {0.25, 0.5, 0.75, 1.0}) {
            for (const double along : {0.0, 0.25, 0.5, 0.75}) {
                points.push_back(middle + out * (a + along * (b - a) - middle));
            }
        }
    }
    return points;
}

// The least change of the coordinate from one output pixel to the next.
double least_slope(const Coordinate& coordinate, const Polygon& points) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec2& point : points) {
        least = std::min(least, coordinate.slope_at(point));
    }
    return least;
}

double area_of(const Polygon& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2& a = polygon[i];
        const Vec2& b = polygon[(i + 1) % polygon.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return std::abs(twice) / 2;
}

// A face before its pixels are counted.
struct Plan {
    Face face;
    Interval range_u, range_v;
};

// Pixels beyond the seen part on every side: the warp's filter reaches two to either side.
constexpr int margin = 2;
// Bounds of a face's area: in intermediate pixels that the part it serves would have at one pitch all
// over, and a number that costs nothing.
constexpr double most_pixels_per_pixel = 4;
constexpr double few_pixels = 512 * 512;

// Pixels lie at odd multiples of half a pitch: none has a slope of 0. Such a ray from an eye on a cut
// between boxes would lie in the cut, and rounding would deal its samples out to both sides by turns,
// which no order of the boxes could put right.
void lay_pixels(const Interval& range, double& pitch, double& origin, int& count) {
    constexpr double room = Factorisation::max_side - 3 - 2 * margin;
    // Any pitch that can be computed with will do for a picture of no more than one point.
    pitch = std::clamp(std::max(pitch, (range.hi - range.lo) / room), 1e-29, 1e29);
    origin = (std::floor(range.lo / pitch) - margin + 0.5) * pitch;
    count = static_cast<int>(std::ceil((range.hi - origin) / pitch)) + 1 + margin;
}

// Gives `faces` their pixels, coarser where they would be too many together.
void lay_all(std::vector<Plan>& plans, Factorisation& factorisation) {
    const auto total = [&] {
        std::int64_t area = 0;
        for (Plan& plan : plans) {
            lay_pixels(plan.range_u, plan.face.pitch.x, plan.face.origin.x, plan.face.width);
            lay_pixels(plan.range_v, plan.face.pitch.y, plan.face.origin.y, plan.face.height);
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
    const Polygon points = strewn(seen);
    Vec2& pitch = plan.face.pitch;
    pitch = Vec2(least_slope(u, points), least_slope(v, points)) / resolution;
    // In a wide or stretched view the slopes change much across the picture: what the densest part needs
    // is given to all of it within a bound.
    const double pixels =
        (plan.range_u.hi - plan.range_u.lo) / pitch.x * (plan.range_v.hi - plan.range_v.lo) / pitch.y;
    const double enough =
        std::max(most_pixels_per_pixel * area_of(seen) * resolution * resolution, few_pixels);
    pitch *= std::sqrt(std::max(1.0, pixels / enough));
    plans.push_back(plan);
}

// The planes along an axis that what is shown of the cube ends at.
struct Ends {
    double first, last;
};
Ends ends_of_shown(const Factorisation& factorisation, int axis) {
    const volume::Box shown = factorisation.shown();
    const auto a = static_cast<std::size_t>(axis);
    return {static_cast<double>(shown.lo[a]), static_cast<double>(shown.hi[a])};
}

// The slopes, as seen from the eye, of what is shown of the cube in front of it.
Interval slopes_of_shown(const Factorisation& factorisation, const Face& face, const SliceRange& slices,
                         int axis) {
    const Ends ends = ends_of_shown(factorisation, axis);
    Interval range;
    for (const std::int64_t k : {slices.first, slices.last}) {
        const double depth = factorisation.slice_place(k) - factorisation.eye[face.axis];
        range.add((ends.first - factorisation.eye[axis]) / depth);
        range.add((ends.last - factorisation.eye[axis]) / depth);
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
            const volume::Box shown = factorisation.shown();
            const auto a = static_cast<std::size_t>(axis);
            const SliceRange slices = slices_in_front(factorisation, face, shown.lo[a], shown.hi[a]);
            if (slices.empty()) {
                continue;
            }
            const Linear forward = sign * component(axis);
            const Coordinate u{sign * component(face.u_axis()), forward};
            const Coordinate v{sign * component(face.v_axis()), forward};
            Polygon seen = u.clipped(picture, slopes_of_shown(factorisation, face, slices, face.u_axis()));
            seen = v.clipped(seen, slopes_of_shown(factorisation, face, slices, face.v_axis()));
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
    const Ends along = ends_of_shown(factorisation, axis);
    // Where a picture's rays cross slice 0, and where lines along them through the cube do.
    const auto coordinate = [&](int a) {
        const double shear = direction[a] / direction[axis];
        const auto on_slice_0 = [&](const Vec3& p) { return p[a] - shear * p[axis]; };
        return Coordinate{{on_slice_0(rays.origin), on_slice_0(rays.origin_x), on_slice_0(rays.origin_y)},
                          {1, 0, 0}};
    };
    const auto reach = [&](int a) {
        const double shear = direction[a] / direction[axis];
        const Ends ends = ends_of_shown(factorisation, a);
        Interval range;
        for (const double plane : {along.first, along.last}) {
            range.add(ends.first - shear * plane);
            range.add(ends.last - shear * plane);
        }
        return range;
    };
    const Coordinate u = coordinate(face.u_axis());
    const Coordinate v = coordinate(face.v_axis());
    const Polygon seen = v.clipped(u.clipped(picture, reach(face.u_axis())), reach(face.v_axis()));
    add_plan(plans, face, seen, u, v, resolution);
}

// The distance along a face's axis of the nearest plane, `nearest` or beyond, where [first, last] meets what
// is seen between two slopes by an eye at `eye`.
double seen_from(double nearest, double eye, double least_slope, double greatest_slope, const Ends& ends) {
    // The line of the least slope is to be below the last there, that of the greatest above the first.
    if (eye + least_slope * nearest > ends.last) {
        nearest = least_slope < 0 ? (ends.last - eye) / least_slope : nearest;
    }
    if (eye + greatest_slope * nearest < ends.first) {
        nearest = greatest_slope > 0 ? (ends.first - eye) / greatest_slope : nearest;
    }
    return nearest;
}

// How far from the eye the plane is, of what is shown of the cube, that lies so far from the nearest that a
// face sees (0) to the farthest (1): from pixel to pixel are pitch times as many voxels. In a parallel view
// they are as many as the pitch.
double spread_at(const Factorisation& factorisation, const Plan& plan, double farther) {
    const Face& face = plan.face;
    if (factorisation.projection == Projection::parallel) {
        return 1;
    }
    const Ends ends = ends_of_shown(factorisation, face.axis);
    const auto along = [&](double nearest, int axis, const Interval& slopes) {
        // Slopes are those along the axis, whichever way the face looks: going against it turns them round.
        const double eye = factorisation.eye[axis];
        const Ends sides = ends_of_shown(factorisation, axis);
        return face.sign > 0 ? seen_from(nearest, eye, slopes.lo, slopes.hi, sides)
                             : seen_from(nearest, eye, -slopes.hi, -slopes.lo, sides);
    };
    const double eye = factorisation.eye[face.axis];
    double nearest = std::max(0.0, face.sign > 0 ? ends.first - eye : eye - ends.last);
    nearest = along(nearest, face.u_axis(), plan.range_u);
    nearest = along(nearest, face.v_axis(), plan.range_v);
    const double farthest = face.sign > 0 ? ends.last - eye : eye - ends.first;
    return nearest + farther * (farthest - nearest);
}

// Voxels from pixel to pixel where they are fewest: on the nearest plane, along either side of a pixel.
double fewest_voxels_per_pixel(const Factorisation& factorisation, const std::vector<Plan>& plans) {
    double fewest = std::numeric_limits<double>::infinity();
    for (const Plan& plan : plans) {
        const Vec2& pitch = plan.face.pitch;
        fewest = std::min(fewest, std::min(pitch.x, pitch.y) * spread_at(factorisation, plan, 0));
    }
    return fewest;
}

// Whether voxels are so large that what lies between two slices shows, in what fills the picture: a quarter
// into the cube.
bool magnified(const Factorisation& factorisation, const std::vector<Plan>& plans) {
    constexpr double most_pixels_per_voxel = 1.25, quarter = 0.25;
    return std::any_of(plans.begin(), plans.end(), [&](const Plan& plan) {
        const Vec2& pitch = plan.face.pitch;
        return most_pixels_per_voxel * std::sqrt(pitch.x * pitch.y) *
                   spread_at(factorisation, plan, quarter) <
               1;
    });
}

// The coarsest level that what is shown has a few nodes of along every axis: its faces cut through cells that
// mix what is on both sides.
int coarsest_level_shown(const Factorisation& factorisation) {
    constexpr std::int64_t least_cells = 4;
    int level = volume::coarsest_level(factorisation.lattice.n);
    if (factorisation.crop) {
        const auto [x, y, z] = factorisation.crop->plane_counts();
        while (level > 0 && (least_cells << level) > std::min({x, y, z}) - 1) {
            --level;
        }
    }
    return level;
}

int slice_exponent(const Factorisation& factorisation, const std::vector<Plan>& plans,
                   const Sampling& sampling) {
    if (sampling.level_of_detail) {
        // The level whose voxels are nearest to a pixel, by ratio.
        const double level = std::round(std::log2(fewest_voxels_per_pixel(factorisation, plans)));
        const int coarsest = coarsest_level_shown(factorisation);
        if (level > 0 && coarsest > 0) {
            return static_cast<int>(std::min<double>(level, sampling.classify == Classify::pre_integrated
                                                                ? std::min(coarsest, volume::max_margin_level)
                                                                : coarsest));
        }
    }
    return sampling.finer_magnified && magnified(factorisation, plans) ? -1 : sampling.slice_exponent;
}

}  // namespace

Factorisation factorise(const Camera& camera, const ImageSize& size, const Lattice& lattice,
                        const Sampling& sampling, const std::optional<volume::Box>& crop) {
    const Rays rays = in_voxel_space(rays_of(camera, size), lattice);
    Factorisation factorisation{
        .projection = camera.projection,
        .lattice = lattice,
        .classify = sampling.classify,
        .opaque = sampling.opaque,
        .crop = crop};
    const Polygon picture = whole_picture(size);
    std::vector<Plan> plans;
    if (camera.projection == Projection::perspective) {
        factorisation.eye = rays.origin;
        factorisation.direction = lattice.voxel_direction(glm::normalize(camera.target - camera.eye));
        plan_perspective(plans, factorisation, rays, picture, sampling.resolution);
    } else {
        factorisation.direction = rays.dir;
        plan_parallel(plans, factorisation, rays, picture, sampling.resolution);
    }
    lay_all(plans, factorisation);
    factorisation.slice_exponent = slice_exponent(factorisation, plans, sampling);
    return factorisation;
}

std::vector<Factorisation> factorise(std::span<const Camera> cameras, const ImageSize& size,
                                     const Lattice& lattice, const Sampling& sampling,
                                     const std::optional<volume::Box>& crop) {
    std::vector<Factorisation> each;
    for (const Camera& camera : cameras) {
        each.push_back(factorise(camera, size, lattice, sampling, crop));
    }
    const auto finest = std::ranges::min_element(each, {}, &Factorisation::slice_exponent);
    for (Factorisation& factorisation : each) {
        factorisation.slice_exponent = finest->slice_exponent;
    }
    return each;
}

}  // namespace shearwater::view
