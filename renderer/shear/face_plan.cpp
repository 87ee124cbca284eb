#include "renderer/shear/face_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace shearwater::shear {

using view::Face;
using view::Factorisation;
using view::PixelRange;
using view::Rect;
using view::SliceMap;
using view::SliceRange;
using volume::Box;

// Whether samples on the upper face of what is shown of a box are its own: the cube ends there, or what is
// shown of it ends before the box does.
bool FacePlan::closed(const Box& box, int axis) const {
    const auto a = static_cast<std::size_t>(axis);
    return box.hi[a] == last_voxel_[a] || shown_.hi[a] < box.hi[a];
}

// What is shown of a box; upside down along an axis where nothing is.
Box FacePlan::shown_of(const Box& box) const {
    Box part;
    for (std::size_t a = 0; a < 3; ++a) {
        part.lo[a] = std::max(box.lo[a], shown_.lo[a]);
        part.hi[a] = std::min(box.hi[a], shown_.hi[a]);
    }
    return part;
}

SliceRange FacePlan::owned_slices(const Box& box) const {
    const Box part = shown_of(box);
    if (part.lo[0] > part.hi[0] || part.lo[1] > part.hi[1] || part.lo[2] > part.hi[2]) {
        return {};
    }
    const auto a = static_cast<std::size_t>(face_.axis);
    SliceRange slices = view::slices_in_front(factorisation_, face_, part.lo[a], part.hi[a]);
    if (!closed(box, face_.axis) &&
        factorisation_.slice_place(slices.last) == static_cast<double>(part.hi[a])) {
        --slices.last;
    }
    return slices;
}

Stretch FacePlan::of_row(int j) const {
    const auto a = static_cast<std::size_t>(face_.axis);
    Stretch row{static_cast<double>(shown_.lo[a]), static_cast<double>(shown_.hi[a])};
    if (perspective()) {
        const double eye = factorisation_.eye[face_.axis];
        (face_.sign > 0 ? row.from : row.to) =
            face_.sign > 0 ? std::max(row.from, eye) : std::min(row.to, eye);
    }
    return slow_clip_(row, place_of(slow_axis(), j));
}

FacePlan::FacePlan(const BrickVolume& volume, const Factorisation& factorisation, int face_index)
    : factorisation_(factorisation),
      face_(factorisation.faces[static_cast<std::size_t>(face_index)]),
      nodes_per_voxel_(std::ldexp(1.0, -level())),
      shown_(factorisation.shown()),
      last_voxel_{volume.cube()[0] - 1, volume.cube()[1] - 1, volume.cube()[2] - 1},
      window_(turn(view::window_of(factorisation, face_, shown_of(volume.box())))),
      slices_(owned_slices(volume.box())),
      fast_clip_(factorisation, face_, fast_axis()),
      slow_clip_(factorisation, face_, slow_axis()) {
    if (slices_.empty() || window_.empty()) {
        window_ = {};
        return;
    }
    gentle_ = gentle_rays();
    for (int j = window_.y0; j < window_.y1; ++j) {
        rows_.push_back(of_row(j));
    }
    for (int i = window_.x0; i < window_.x1; ++i) {
        columns_.push_back(fast_clip_(everywhere, place_of(fast_axis(), i)));
    }
    plans_.resize(static_cast<std::size_t>(slice_count()));
    inside_.resize(plans_.size() + 2);
    for (std::int64_t k = slices_.first - 1; k <= slices_.last + 1; ++k) {
        lay_slice(volume.box(), k);
    }
    for (std::int64_t k = slices_.first; k <= slices_.last; ++k) {
        SlicePlan& plan = plans_[slot(k)];
        plan.map = node_map(node_place(k));
        plan.whole = intersection(inside(k - 1), inside(k + 1));
    }
}

void FacePlan::lay_slice(const Box& box, std::int64_t k) {
    const auto w = static_cast<std::size_t>(face_.axis);
    const SliceRange cube = view::slices_in_front(factorisation_, face_, shown_.lo[w], shown_.hi[w]);
    if (k < cube.first || k > cube.last) {
        return;
    }
    const SliceMap map = slice_map(factorisation_.slice_place(k));
    const Rect size = turn({0, 0, face_.width, face_.height});
    // Those with samples in [lo, hi), or up to hi where they are a box's own there.
    const auto pixels_in = [&](const Box& part, const auto& closed_along) {
        const auto along = [&](int axis, double offset, double scale, int count) {
            const auto a = static_cast<std::size_t>(axis);
            return view::pixels_between(offset, scale, static_cast<double>(part.lo[a]),
                                        static_cast<double>(part.hi[a]), closed_along(axis), count);
        };
        const PixelRange fast = along(fast_axis(), map.u_offset, map.u_scale, size.x1);
        const PixelRange slow = along(slow_axis(), map.v_offset, map.v_scale, size.y1);
        return Rect{fast.first, slow.first, fast.last, slow.last};
    };
    inside_[slot(k) + 1] = pixels_in(shown_, [](int) { return true; });
    if (slices_.first <= k && k <= slices_.last) {
        plans_[slot(k)].owned = pixels_in(shown_of(box), [&](int axis) { return closed(box, axis); });
    }
}

Rect FacePlan::gentle_rays() const {
    const Rect all = turn({0, 0, face_.width, face_.height});
    if (!perspective()) {
        return all;
    }
    const auto along = [&](int axis, int count) {
        const auto [origin, pitch] = line_of(axis);
        return view::pixels_between(origin, pitch, -1, 1, true, count);
    };
    const PixelRange fast = along(fast_axis(), all.x1);
    const PixelRange slow = along(slow_axis(), all.y1);
    return {fast.first, slow.first, fast.last, slow.last};
}

SliceMap FacePlan::slice_map(double w) const {
    const SliceMap map = factorisation_.slice_map(face_, w);
    return turned() ? SliceMap{map.v_offset, map.v_scale, map.u_offset, map.u_scale} : map;
}

SliceMap FacePlan::node_map(double place) const {
    const SliceMap map = slice_map(place / nodes_per_voxel_);
    return {map.u_offset * nodes_per_voxel_, map.u_scale * nodes_per_voxel_, map.v_offset * nodes_per_voxel_,
            map.v_scale * nodes_per_voxel_};
}

bool FacePlan::on_planes() const {
    const auto on_plane = [](double place) { return place == std::floor(place); };
    return on_plane(node_place(0)) && on_plane(node_place(1));
}

void FacePlan::steps(int i, int j, std::span<float> out) const {
    if (!perspective()) {
        std::fill(out.begin(), out.end(), static_cast<float>(factorisation_.step(face_, i, j)));
        return;
    }
    // As Factorisation::step, to the precision of what it gives.
    const view::Vec3& spacing = factorisation_.lattice.spacing;
    const auto square = [](double x) { return x * x; };
    const double across = spacing[face_.axis], pitch = factorisation_.slice_pitch();
    const double slow = place_of(slow_axis(), j) * spacing[slow_axis()];
    const auto rest = static_cast<float>(square(pitch) * (square(across) + square(slow)));
    const auto [origin, each] = line_of(fast_axis());
    const double fast = pitch * spacing[fast_axis()];
    const auto first = static_cast<float>(fast * origin);
    const auto further = static_cast<float>(fast * each);
    const int count = static_cast<int>(out.size());
    float* const to = out.data();
    for (int n = 0; n < count; ++n) {
        const float sideways = first + further * static_cast<float>(i + n);
        to[n] = std::sqrt(rest + sideways * sideways);
    }
}

// A pixel's place along an in-plane axis, as Face counts it: origin + pitch * pixel.
std::pair<double, double> FacePlan::line_of(int axis) const {
    return axis == face_.u_axis() ? std::pair(face_.origin.x, face_.pitch.x)
                                  : std::pair(face_.origin.y, face_.pitch.y);
}

double FacePlan::place_of(int axis, int pixel) const {
    const auto [origin, pitch] = line_of(axis);
    return origin + pitch * pixel;
}

const Rect& FacePlan::inside(std::int64_t k) const {
    return inside_[slot(k) + 1];
}

// `steps(ray, i, j)`: how many slice distances a length of what the ray of pixel (i, j) has of the cube
// stands for.
template <class Steps>
void FacePlan::write(const Rect& pixels, const RayLengths& lengths, const Steps& steps) const {
    const auto write_one = [&](int i, int j) {
        const Stretch& row = rows_[static_cast<std::size_t>(j - window_.y0)];
        const Stretch& column = columns_[static_cast<std::size_t>(i - window_.x0)];
        const Stretch ray{std::max(row.from, column.from), std::min(row.to, column.to)};
        const std::ptrdiff_t at = lengths.offset(i, j);
        lengths.lengths[at] = lengths.steps[at] * static_cast<float>(steps(ray, i, j));
    };
    // A rim is long along one axis, and a pixel or two wide along the other.
    if (pixels.width() < pixels.height()) {
        for (int i = pixels.x0; i < pixels.x1; ++i) {
            for (int j = pixels.y0; j < pixels.y1; ++j) {
                write_one(i, j);
            }
        }
    } else {
        for (int j = pixels.y0; j < pixels.y1; ++j) {
            for (int i = pixels.x0; i < pixels.x1; ++i) {
                write_one(i, j);
            }
        }
    }
}

void FacePlan::write_shares(std::int64_t k, const Rect& pixels, const RayLengths& lengths) const {
    const double place = factorisation_.slice_place(k);
    const double half = factorisation_.slice_pitch() / 2;
    const double steps_per_voxel = 1 / factorisation_.slice_pitch();  // a power of two
    const Rect below = inside(k - 1), above = inside(k + 1);
    const auto has = [](const Rect& rect, int i, int j) {
        return (rect.x0 <= i) & (i < rect.x1) & (rect.y0 <= j) & (j < rect.y1);
    };
    write(pixels, lengths, [=](const Stretch& ray, int i, int j) {
        // On the cube's first plane a ray is at its end, as all are.
        const double start = std::min(place, ray.from), end = std::max(place, ray.to);
        const double from = has(below, i, j) ? place - half : start,
                     to = has(above, i, j) ? place + half : end;
        return std::min((to - from) * steps_per_voxel, 2.0);
    });
}

// `sign`: towards lower planes or higher ones.
void FacePlan::write_rims(std::int64_t k, int sign, const Rect& pixels, const RayLengths& lengths) const {
    const double place = factorisation_.slice_place(k);
    const double steps_per_voxel = 1 / factorisation_.slice_pitch();
    write(pixels, lengths, [=](const Stretch& ray, int, int) {
        const double length = sign > 0 ? ray.to - place : place - ray.from;
        return std::clamp(length * steps_per_voxel, 0.0, 1.0);
    });
}

}  // namespace shearwater::shear
