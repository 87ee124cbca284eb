#include "renderer/shear/face_plan.h"

#include <algorithm>
#include <cmath>

namespace shearwater::shear {

namespace {

using view::Face;
using view::Factorisation;
using view::PixelRange;
using view::Rect;
using view::SliceMap;
using view::SliceRange;
using volume::Box;

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

FacePlan::FacePlan(const BrickVolume& volume, const Factorisation& factorisation, int face_index)
    : factorisation_(factorisation),
      face_(factorisation.faces[static_cast<std::size_t>(face_index)]),
      last_voxel_{volume.cube()[0] - 1, volume.cube()[1] - 1, volume.cube()[2] - 1},
      window_(turn(view::window_of(factorisation, face_, volume.box()))),
      slices_(owned_slices(factorisation, face_, volume.box(), last_voxel_)) {
    if (slices_.empty() || window_.empty()) {
        window_ = {};
        return;
    }
    owned_.resize(static_cast<std::size_t>(slice_count()));
    inside_.resize(owned_.size() + 2);
    for (std::int64_t k = slices_.first - 1; k <= slices_.last + 1; ++k) {
        lay_slice(volume.box(), k);
    }
}

void FacePlan::lay_slice(const Box& box, std::int64_t k) {
    const SliceRange cube =
        view::slices_in_front(factorisation_, face_, 0, last_voxel_[static_cast<std::size_t>(face_.axis)]);
    if (k < cube.first || k > cube.last) {
        return;
    }
    const SliceMap map = slice_map(factorisation_.slice_place(k));
    const Rect size = turn({0, 0, face_.width, face_.height});
    // Those with samples in [lo, hi), or up to hi where the cube ends there.
    const auto pixels_in = [&](const Box& part) {
        const auto along = [&](int axis, double offset, double scale, int count) {
            const auto a = static_cast<std::size_t>(axis);
            return view::pixels_between(offset, scale, static_cast<double>(part.lo[a]),
                                        static_cast<double>(part.hi[a]), part.hi[a] == last_voxel_[a], count);
        };
        const PixelRange fast = along(fast_axis(), map.u_offset, map.u_scale, size.x1);
        const PixelRange slow = along(slow_axis(), map.v_offset, map.v_scale, size.y1);
        return Rect{fast.first, slow.first, fast.last, slow.last};
    };
    inside_[slot(k) + 1] = pixels_in({{0, 0, 0}, last_voxel_});
    if (slices_.first <= k && k <= slices_.last) {
        owned_[slot(k)] = pixels_in(box);
    }
}

SliceMap FacePlan::slice_map(double w) const {
    const SliceMap map = factorisation_.slice_map(face_, w);
    return turned() ? SliceMap{map.v_offset, map.v_scale, map.u_offset, map.u_scale} : map;
}

SliceMap FacePlan::node_map(double place) const {
    const double nodes_per_voxel = std::ldexp(1.0, -level());
    const SliceMap map = slice_map(place / nodes_per_voxel);
    return {map.u_offset * nodes_per_voxel, map.u_scale * nodes_per_voxel, map.v_offset * nodes_per_voxel,
            map.v_scale * nodes_per_voxel};
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
