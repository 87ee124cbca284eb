#include "common/view/ray.h"

#include <algorithm>
#include <cmath>

namespace shearwater::view {

namespace {

// The ray's point on the plane at w of its principal axis.
Vec3 point_at(const Factorisation& ray, double w) {
    const Face& face = ray.faces[0];
    const SliceMap map = ray.slice_map(face, w);
    Vec3 point;
    point[face.axis] = w;
    point[face.u_axis()] = map.u_offset;
    point[face.v_axis()] = map.v_offset;
    return point;
}

}  // namespace

Factorisation factorise_ray(const Camera& camera, const ImageSize& size, const Vec2& at,
                            const Lattice& lattice) {
    const Rays rays = in_voxel_space(rays_of(camera, size), lattice);
    const Vec3 origin = rays.origin_at(at.x, at.y);
    const Vec3 direction = rays.direction_at(at.x, at.y);
    Face face{.axis = 0, .width = 1, .height = 1, .pitch = {1, 1}};
    for (int axis = 1; axis < 3; ++axis) {
        if (std::abs(direction[axis]) > std::abs(direction[face.axis])) {
            face.axis = axis;
        }
    }
    face.sign = direction[face.axis] > 0 ? 1 : -1;
    const double slope_u = direction[face.u_axis()] / direction[face.axis];
    const double slope_v = direction[face.v_axis()] / direction[face.axis];
    if (camera.projection == Projection::perspective) {
        face.origin = {slope_u, slope_v};
    } else {
        face.origin = {origin[face.u_axis()] - slope_u * origin[face.axis],
                       origin[face.v_axis()] - slope_v * origin[face.axis]};
    }
    return {.projection = camera.projection,
            .lattice = lattice,
            .eye = origin,
            .direction = direction,
            .slice_exponent = -1,
            .faces = {face}};
}

bool is_ray(const Factorisation& factorisation) {
    return factorisation.faces.size() == 1 && factorisation.faces[0].width == 1 &&
           factorisation.faces[0].height == 1 && factorisation.slice_exponent == -1 &&
           factorisation.classify == Classify::post;
}

// The depth is spread evenly over what a sample stands for, so that the place does not jump from slice to
// slice.
std::optional<RayHit> half_way(const Factorisation& ray, std::span<const RaySample> samples) {
    constexpr double least_seen = 1.0 / 510;
    double all = 0;
    for (const RaySample& sample : samples) {
        all += static_cast<double>(sample.depth);
    }
    const double opacity = -std::expm1(-all);
    if (!(opacity >= least_seen)) {
        return std::nullopt;
    }
    const double half = -std::log1p(-opacity / 2);
    double before = 0;
    for (const RaySample& sample : samples) {
        const auto depth = static_cast<double>(sample.depth);
        if (before + depth >= half) {
            const double into = (half - before) / depth - 0.5;  // slices from this one
            const Face& face = ray.faces[0];
            const double last = static_cast<double>(ray.lattice.n[static_cast<std::size_t>(face.axis)] - 1);
            const double w = ray.slice_place(sample.slice) + face.sign * into * ray.slice_pitch();
            Vec3 voxel = point_at(ray, std::clamp(w, 0.0, last));
            for (int axis = 0; axis < 3; ++axis) {
                const auto n = ray.lattice.n[static_cast<std::size_t>(axis)];
                voxel[axis] = std::clamp(voxel[axis], 0.0, static_cast<double>(n - 1));
            }
            return RayHit{voxel, opacity};
        }
        before += depth;
    }
    return std::nullopt;  // rounding alone
}

}  // namespace shearwater::view
