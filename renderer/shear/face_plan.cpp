#include "renderer/shear/face_plan.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace shearwater::shear {

namespace {

using view::Face;
using view::Factorisation;
using view::PixelRange;
using view::Projection;
using view::SliceMap;
using view::SliceRange;
using volume::Box;

// The brick at one place along an axis, on the others the first: its extent along that axis is theirs all.
const Brick& brick_along(const BrickVolume& volume, int axis, std::int64_t place) {
    volume::Index3 at{};
    at[static_cast<std::size_t>(axis)] = place;
    return volume.brick(at[0], at[1], at[2]);
}

std::int64_t last_owned_plane(const Box& box, int axis, const volume::Index3& last_voxel) {
    const auto a = static_cast<std::size_t>(axis);
    return box.hi[a] == last_voxel[a] ? box.hi[a] : box.hi[a] - 1;
}

// Cuts a ray's stretch [a, b] along w down to where  at + slope * (w - start)  is within [0, last].
void clip(double& a, double& b, double start, double at, double slope, double last) {
    if (slope == 0) {
        return;
    }
    const double to_first = start + (0 - at) / slope;
    const double to_last = start + (last - at) / slope;
    a = std::max(a, std::min(to_first, to_last));
    b = std::min(b, std::max(to_first, to_last));
}

}  // namespace

FacePlan::FacePlan(const BrickVolume& volume, const Factorisation& factorisation, int face_index)
    : factorisation_(factorisation),
      face_(factorisation.faces[static_cast<std::size_t>(face_index)]),
      face_index_(face_index),
      last_voxel_{volume.cube()[0] - 1, volume.cube()[1] - 1, volume.cube()[2] - 1},
      window_(view::window_of(factorisation, face_, volume.box())),
      slices_(view::slices_in_front(factorisation, face_,
                                    volume.box().lo[static_cast<std::size_t>(face_.axis)],
                                    last_owned_plane(volume.box(), face_.axis, last_voxel_))) {
    if (slices_.empty()) {
        window_ = {};
    }
    if (window_.empty()) {
        return;
    }
    order_ = {front_to_back(volume, face_.axis), front_to_back(volume, face_.u_axis()),
              front_to_back(volume, face_.v_axis())};
    for (std::int64_t layer = 0; layer < volume.grid()[static_cast<std::size_t>(face_.axis)]; ++layer) {
        const Box& box = brick_along(volume, face_.axis, layer).box;
        layers_.push_back(view::slices_in_front(factorisation_, face_,
                                                box.lo[static_cast<std::size_t>(face_.axis)],
                                                last_owned_plane(box, face_.axis, last_voxel_)));
    }
    lay_slices(volume);
}

// Nearest first. In perspective all rays go away from the eye, so bricks on one side of it are in order
// of distance, and those on different sides never on one ray.
std::vector<std::int64_t> FacePlan::front_to_back(const BrickVolume& volume, int axis) const {
    const auto a = static_cast<std::size_t>(axis);
    std::vector<std::int64_t> order(static_cast<std::size_t>(volume.grid()[a]));
    std::iota(order.begin(), order.end(), 0);
    const auto distance = [&](std::int64_t place) {
        const Box& box = brick_along(volume, axis, place).box;
        const auto lo = static_cast<double>(box.lo[a]);
        const auto hi = static_cast<double>(box.hi[a]);
        if (factorisation_.projection == Projection::parallel) {
            return factorisation_.direction[axis] < 0 ? -lo : lo;
        }
        return std::max({0.0, lo - factorisation_.eye[axis], factorisation_.eye[axis] - hi});
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::int64_t x, std::int64_t y) { return distance(x) < distance(y); });
    return order;
}

void FacePlan::lay_slices(const BrickVolume& volume) {
    const auto ranges = [&](std::vector<PixelRange>& out, int axis, double offset, double scale, int count) {
        const auto a = static_cast<std::size_t>(axis);
        for (std::int64_t place = 0; place < volume.grid()[a]; ++place) {
            const Box& box = brick_along(volume, axis, place).box;
            out.push_back(view::pixels_between(offset, scale, static_cast<double>(box.lo[a]),
                                               static_cast<double>(box.hi[a]), box.hi[a] == last_voxel_[a],
                                               count));
        }
    };
    const SliceRange cube =
        view::slices_in_front(factorisation_, face_, 0, last_voxel_[static_cast<std::size_t>(face_.axis)]);
    for (std::int64_t k = slices_.first - 1; k <= slices_.last + 1; ++k) {
        if (k < cube.first || k > cube.last) {
            inside_.push_back({});
            continue;
        }
        const SliceMap map = factorisation_.slice_map(face_, static_cast<double>(k));
        const auto whole = [&](int axis, double offset, double scale, int count) {
            const auto last = static_cast<double>(last_voxel_[static_cast<std::size_t>(axis)]);
            return view::pixels_between(offset, scale, 0, last, true, count);
        };
        const PixelRange u = whole(face_.u_axis(), map.u_offset, map.u_scale, face_.width);
        const PixelRange v = whole(face_.v_axis(), map.v_offset, map.v_scale, face_.height);
        inside_.push_back({u.first, v.first, u.last, v.last});
        if (k >= slices_.first && k <= slices_.last) {
            ranges(columns_, face_.u_axis(), map.u_offset, map.u_scale, face_.width);
            ranges(rows_, face_.v_axis(), map.v_offset, map.v_scale, face_.height);
        }
    }
}

SliceRange FacePlan::slices_of_layer(std::int64_t layer) const {
    return layers_[static_cast<std::size_t>(layer)];
}

const PixelRange& FacePlan::pixels_of_column(std::int64_t k, std::int64_t column) const {
    return columns_[slot(k) * order_[1].size() + static_cast<std::size_t>(column)];
}

const PixelRange& FacePlan::pixels_of_row(std::int64_t k, std::int64_t row) const {
    return rows_[slot(k) * order_[2].size() + static_cast<std::size_t>(row)];
}

const view::Rect& FacePlan::inside(std::int64_t k) const {
    return inside_[slot(k) + 1];
}

double FacePlan::share(std::int64_t k, int i, int j) const {
    const bool perspective = factorisation_.projection == Projection::perspective;
    const double start = perspective ? factorisation_.eye[face_.axis] : 0;
    double a = 0;
    double b = static_cast<double>(last_voxel_[static_cast<std::size_t>(face_.axis)]);
    if (perspective) {
        (face_.sign > 0 ? a : b) = face_.sign > 0 ? std::max(a, start) : std::min(b, start);
    }
    const auto clip_along = [&](int axis, double place) {
        const double at = perspective ? factorisation_.eye[axis] : place;
        const double slope =
            perspective ? place : factorisation_.direction[axis] / factorisation_.direction[face_.axis];
        clip(a, b, start, at, slope, static_cast<double>(last_voxel_[static_cast<std::size_t>(axis)]));
    };
    clip_along(face_.u_axis(), face_.origin.x + i * face_.pitch.x);
    clip_along(face_.v_axis(), face_.origin.y + j * face_.pitch.y);

    const auto has = [i, j](const view::Rect& rect) {
        return rect.x0 <= i && i < rect.x1 && rect.y0 <= j && j < rect.y1;
    };
    const auto here = static_cast<double>(k);
    const double from = has(inside(k - 1)) ? here - 0.5 : a;
    const double to = has(inside(k + 1)) ? here + 0.5 : b;
    return std::clamp(to - from, 0.0, 2.0);
}

}  // namespace shearwater::shear
