#include "client/model/edge_line.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/view/project.h"

namespace shearwater::model {

namespace {

constexpr int samples = 65;  // along an edge

using Faces = std::array<std::array<bool, 2>, 3>;  // by axis, lower and upper

// Which faces turn their outer side to the eye.
Faces faces_seen(const view::Camera& camera, const view::ImageSize& size, const view::Lattice& lattice,
                 const volume::Box& box) {
    const view::Vec3 eye = lattice.voxel_from_world(camera.eye);
    const view::Vec3 ray = lattice.voxel_direction(view::rays_of(camera, size).dir);
    constexpr double edge_on = 1e-9;
    Faces seen{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        if (camera.projection == view::Projection::perspective) {
            seen[a] = {eye[axis]<static_cast<double>(box.lo[a]), eye[axis]> static_cast<double>(box.hi[a])};
        } else {
            const double aslant = edge_on * glm::length(ray);
            seen[a] = {ray[axis] > aslant, ray[axis] < -aslant};
        }
    }
    return seen;
}

view::Vec2 pixels_of(const Edge& edge, double t, const view::Camera& camera, const view::ImageSize& size,
                     const view::Lattice& lattice) {
    return view::project(camera, size, lattice.world_from_voxel(edge.at(t))).at;
}

struct Value {
    double t = 0, value = 0;  // on a circle prolonged beyond its ends
};
std::vector<Value> values_along(const Edge& edge, const Part& part, const wcs::Axis& axis,
                                const volume::Index3& n) {
    std::vector<Value> values;
    double last = std::nan("");
    for (int i = 0; i < samples; ++i) {
        const double t = part.first + (part.last - part.first) * i / (samples - 1);
        const view::Vec3 voxel = edge.at(t);
        const double value = wcs::value_at(axis, n, {voxel.x, voxel.y, voxel.z});
        const double prolonged = std::isfinite(last) ? last + wcs::difference(axis, last, value) : value;
        values.push_back({t, prolonged});
        last = std::isfinite(prolonged) ? prolonged : last;
    }
    return values;
}

}  // namespace

std::vector<Edge> outline(const view::Camera& camera, const view::ImageSize& size,
                          const view::Lattice& lattice, const volume::Box& box) {
    const Faces seen = faces_seen(camera, size, lattice, box);
    std::vector<Edge> edges;
    for (int along = 0; along < 3; ++along) {
        const int b = (along + 1) % 3, c = (along + 2) % 3;
        for (int corner = 0; corner < 4; ++corner) {
            const std::size_t b_side = corner & 1, c_side = corner >> 1;
            if (seen[static_cast<std::size_t>(b)][b_side] == seen[static_cast<std::size_t>(c)][c_side]) {
                continue;
            }
            Edge edge{.along = along};
            const auto put = [&](int axis, std::size_t from_side, std::size_t to_side) {
                const auto a = static_cast<std::size_t>(axis);
                edge.from[axis] = static_cast<double>(from_side == 0 ? box.lo[a] : box.hi[a]);
                edge.to[axis] = static_cast<double>(to_side == 0 ? box.lo[a] : box.hi[a]);
            };
            put(along, 0, 1);
            put(b, b_side, b_side);
            put(c, c_side, c_side);
            edges.push_back(edge);
        }
    }
    return edges;
}

std::optional<Part> part_in_picture(const Edge& edge, const view::Camera& camera, const view::ImageSize& size,
                                    const view::Lattice& lattice) {
    const auto seen = [&](int i) {
        const view::Projected p = view::project(
            camera, size, lattice.world_from_voxel(edge.at(static_cast<double>(i) / (samples - 1))));
        return p.seen_by(camera) && p.at.x >= 0 && p.at.y >= 0 && p.at.x <= size.width &&
               p.at.y <= size.height;
    };
    int first = 0, length = 0;
    for (int i = 0; i < samples; ++i) {
        int end = i;
        while (end < samples && seen(end)) {
            ++end;
        }
        if (end - i > length) {
            first = i;
            length = end - i;
        }
        i = std::max(i, end);
    }
    if (length < 2) {
        return std::nullopt;
    }
    Part part{.first = static_cast<double>(first) / (samples - 1),
              .last = static_cast<double>(first + length - 1) / (samples - 1)};
    part.from = pixels_of(edge, part.first, camera, size, lattice);
    part.to = pixels_of(edge, part.last, camera, size, lattice);
    return part;
}

std::vector<Crossing> crossings(const Edge& edge, const Part& part, const wcs::Axis& axis,
                                const volume::Index3& n, double step, std::size_t most) {
    std::vector<Crossing> found;
    if (!(step > 0) || !std::isfinite(step)) {
        return found;
    }
    constexpr double a_little = 1e-9;
    const std::vector<Value> values = values_along(edge, part, axis, n);
    for (std::size_t i = 0; i + 1 < values.size(); ++i) {
        const auto& [t0, v0] = values[i];
        const auto& [t1, v1] = values[i + 1];
        if (!std::isfinite(v0) || !std::isfinite(v1) || v0 == v1) {
            continue;
        }
        const double low = std::ceil(std::min(v0, v1) / step - a_little);
        const double high = std::floor(std::max(v0, v1) / step + a_little);
        for (double k = 0; k <= high - low && found.size() < most; ++k) {
            const double value = (v0 < v1 ? low + k : high - k) * step;
            const double t = t0 + (t1 - t0) * std::clamp((value - v0) / (v1 - v0), 0.0, 1.0);
            if (found.empty() || t > found.back().t + a_little) {
                found.push_back({t, value});
            }
        }
    }
    return found;
}

double extent(const Edge& edge, const Part& part, const wcs::Axis& axis, const volume::Index3& n) {
    double least = HUGE_VAL, largest = -HUGE_VAL;
    for (const Value& value : values_along(edge, part, axis, n)) {
        if (std::isfinite(value.value)) {
            least = std::min(least, value.value);
            largest = std::max(largest, value.value);
        }
    }
    return largest > least ? largest - least : 0;
}

}  // namespace shearwater::model
