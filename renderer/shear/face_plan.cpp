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
using view::Rect;
using view::SliceMap;
using view::SliceRange;
using volume::Box;

// The brick at one place along an axis, on the others the first: its extent along that axis is theirs all.
const Brick& brick_along(const BrickVolume& volume, int axis, std::int64_t place) {
    volume::Index3 at{};
    at[static_cast<std::size_t>(axis)] = place;
    return volume.brick(at[0], at[1], at[2]);
}

// The slices of a box's own: those on its upper face only where the cube ends there.
SliceRange owned_slices(const Factorisation& factorisation, const Face& face, const Box& box,
                        const volume::Index3& last_voxel) {
    const auto a = static_cast<std::size_t>(face.axis);
    SliceRange slices = view::slices_in_front(factorisation, face, box.lo[a], box.hi[a]);
    if (box.hi[a] != last_voxel[a] &&
        factorisation.slice_place(slices.last) == static_cast<double>(box.hi[a])) {
        --slices.last;
    }
    return slices;
}

// A stretch of a ray along its principal axis, and where  at + slope * (w - start)  is within [0, last] in
// it.
struct Stretch {
    double from, to;
};
Stretch clipped(const Stretch& stretch, double start, double at, double slope, double last) {
    if (slope == 0) {
        return stretch;
    }
    const double to_first = start - at / slope;
    const double to_last = start + (last - at) / slope;
    return {std::max(stretch.from, std::min(to_first, to_last)),
            std::min(stretch.to, std::max(to_first, to_last))};
}

}  // namespace

FacePlan::FacePlan(const BrickVolume& volume, const Factorisation& factorisation, int face_index,
                   base::Workers& workers)
    : factorisation_(factorisation),
      face_(factorisation.faces[static_cast<std::size_t>(face_index)]),
      last_voxel_{volume.cube()[0] - 1, volume.cube()[1] - 1, volume.cube()[2] - 1},
      window_(turn(view::window_of(factorisation, face_, volume.box()))),
      slices_(owned_slices(factorisation, face_, volume.box(), last_voxel_)) {
    if (slices_.empty()) {
        window_ = {};
    }
    if (window_.empty()) {
        return;
    }
    order_ = {front_to_back(volume, face_.axis), front_to_back(volume, fast_axis()),
              front_to_back(volume, slow_axis())};
    for (std::int64_t layer = 0; layer < volume.grid()[static_cast<std::size_t>(face_.axis)]; ++layer) {
        layers_.push_back(
            owned_slices(factorisation_, face_, brick_along(volume, face_.axis, layer).box, last_voxel_));
    }
    lay_slices(volume, workers);
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
        if (!perspective()) {
            return factorisation_.direction[axis] < 0 ? -lo : lo;
        }
        return std::max({0.0, lo - factorisation_.eye[axis], factorisation_.eye[axis] - hi});
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::int64_t x, std::int64_t y) { return distance(x) < distance(y); });
    return order;
}

void FacePlan::lay_slices(const BrickVolume& volume, base::Workers& workers) {
    constexpr std::int64_t at_once = 32;
    const auto count = slices_.last - slices_.first + 1;
    columns_.resize(static_cast<std::size_t>(count) * order_[1].size());
    rows_.resize(static_cast<std::size_t>(count) * order_[2].size());
    inside_.resize(static_cast<std::size_t>(count) + 2);
    workers.for_each((count + 2 + at_once - 1) / at_once, [&](std::int64_t part) {
        const std::int64_t first = slices_.first - 1 + part * at_once;
        for (std::int64_t k = first; k < std::min(first + at_once, slices_.last + 2); ++k) {
            lay_slice(volume, k);
        }
    });
}

void FacePlan::lay_slice(const BrickVolume& volume, std::int64_t k) {
    const SliceMap map = slice_map(factorisation_.slice_place(k));
    const Rect size = turn({0, 0, face_.width, face_.height});
    const auto last = [&](int axis) {
        return static_cast<double>(last_voxel_[static_cast<std::size_t>(axis)]);
    };
    const SliceRange cube =
        view::slices_in_front(factorisation_, face_, 0, last_voxel_[static_cast<std::size_t>(face_.axis)]);
    if (cube.first <= k && k <= cube.last) {
        const PixelRange fast =
            view::pixels_between(map.u_offset, map.u_scale, 0, last(fast_axis()), true, size.x1);
        const PixelRange slow =
            view::pixels_between(map.v_offset, map.v_scale, 0, last(slow_axis()), true, size.y1);
        inside_[slot(k) + 1] = {fast.first, slow.first, fast.last, slow.last};
    }
    if (k < slices_.first || k > slices_.last) {
        return;
    }
    const auto lay = [&](std::vector<PixelRange>& ranges, int axis, double offset, double scale, int count) {
        const auto a = static_cast<std::size_t>(axis);
        const auto places = volume.grid()[a];
        for (std::int64_t place = 0; place < places; ++place) {
            const Box& box = brick_along(volume, axis, place).box;
            ranges[slot(k) * static_cast<std::size_t>(places) + static_cast<std::size_t>(place)] =
                view::pixels_between(offset, scale, static_cast<double>(box.lo[a]),
                                     static_cast<double>(box.hi[a]), box.hi[a] == last_voxel_[a], count);
        }
    };
    lay(columns_, fast_axis(), map.u_offset, map.u_scale, size.x1);
    lay(rows_, slow_axis(), map.v_offset, map.v_scale, size.y1);
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

SliceMap FacePlan::slice_map(double w) const {
    const SliceMap map = factorisation_.slice_map(face_, w);
    return turned() ? SliceMap{map.v_offset, map.v_scale, map.u_offset, map.u_scale} : map;
}

void FacePlan::steps(int i, int j, std::span<float> out) const {
    const auto step = [&](int at) {
        return static_cast<float>(turned() ? factorisation_.step(face_, j, at)
                                           : factorisation_.step(face_, at, j));
    };
    if (!perspective()) {
        std::fill(out.begin(), out.end(), step(i));
        return;
    }
    for (std::size_t n = 0; n < out.size(); ++n) {
        out[n] = step(i + static_cast<int>(n));
    }
}

const Rect& FacePlan::inside(std::int64_t k) const {
    return inside_[slot(k) + 1];
}

void FacePlan::shares(std::int64_t k, int i, int j, std::span<float> out) const {
    const auto last = [&](int axis) {
        return static_cast<double>(last_voxel_[static_cast<std::size_t>(axis)]);
    };
    const double start = perspective() ? factorisation_.eye[face_.axis] : 0;
    const auto clipped_along = [&](const Stretch& stretch, int axis, int pixel) {
        const bool along_u = axis == face_.u_axis();
        const double place =
            along_u ? face_.origin.x + pixel * face_.pitch.x : face_.origin.y + pixel * face_.pitch.y;
        const double at = perspective() ? factorisation_.eye[axis] : place;
        const double slope =
            perspective() ? place : factorisation_.direction[axis] / factorisation_.direction[face_.axis];
        return clipped(stretch, start, at, slope, last(axis));
    };
    Stretch whole{0, last(face_.axis)};
    if (perspective()) {
        (face_.sign > 0 ? whole.from : whole.to) =
            face_.sign > 0 ? std::max(whole.from, start) : std::min(whole.to, start);
    }
    const Stretch row = clipped_along(whole, slow_axis(), j);
    const double place = factorisation_.slice_place(k);
    const double half = factorisation_.slice_pitch() / 2;
    const auto in_row = [j](const Rect& rect) {
        return rect.y0 <= j && j < rect.y1 ? PixelRange{rect.x0, rect.x1} : PixelRange{};
    };
    const PixelRange before = in_row(inside(k - 1));
    const PixelRange after = in_row(inside(k + 1));
    for (std::size_t n = 0; n < out.size(); ++n) {
        const int at = i + static_cast<int>(n);
        const Stretch ray = clipped_along(row, fast_axis(), at);
        const double from = before.first <= at && at < before.last ? place - half : ray.from;
        const double to = after.first <= at && at < after.last ? place + half : ray.to;
        out[n] = static_cast<float>(std::clamp((to - from) / (2 * half), 0.0, 2.0));
    }
}

}  // namespace shearwater::shear
