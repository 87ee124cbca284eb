#include "common/view/factorisation.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/volume/levels.h"

namespace shearwater::view {

namespace {

// The least i in [0, count] whose coordinate satisfies `reached`, which holds from some i on.
template <class Reached>
int first_reaching(double offset, double scale, double bound, int count, const Reached& reached) {
    const auto at = [&](int i) { return reached(offset + scale * i); };
    // A guess by division, put right by the very expression that samples are placed with.
    const double guess = std::ceil((bound - offset) / scale);
    int i = guess > 0 ? static_cast<int>(std::min(guess, static_cast<double>(count))) : 0;
    while (i > 0 && at(i - 1)) {
        --i;
    }
    while (i < count && !at(i)) {
        ++i;
    }
    return i;
}

base::Status refuse_factorisation(std::string detail) {
    return base::error(base::Code::invalid_argument, "read a factorisation", std::move(detail));
}

bool valid(const Face& face) {
    const auto usable_pitch = [](double pitch) { return pitch > 1e-30 && pitch < 1e30; };
    return face.axis >= 0 && face.axis < 3 && (face.sign == 1 || face.sign == -1) && face.width > 0 &&
           face.height > 0 && face.width <= Factorisation::max_side &&
           face.height <= Factorisation::max_side && std::abs(face.origin.x) < 1e30 &&
           std::abs(face.origin.y) < 1e30 && usable_pitch(face.pitch.x) && usable_pitch(face.pitch.y);
}

}  // namespace

Rect bounding(const Rect& a, const Rect& b) {
    if (a.empty() || b.empty()) {
        return a.empty() ? b : a;
    }
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

std::array<Rect, 4> left_over(const Rect& whole, const Rect& part) {
    const Rect inner = intersection(whole, part);
    if (inner.empty()) {
        return {whole};
    }
    return {Rect{whole.x0, whole.y0, whole.x1, inner.y0}, Rect{whole.x0, inner.y1, whole.x1, whole.y1},
            Rect{whole.x0, inner.y0, inner.x0, inner.y1}, Rect{inner.x1, inner.y0, whole.x1, inner.y1}};
}

Sampling sampling(Quality quality, bool level_of_detail, Classify classify) {
    Sampling sampling{.level_of_detail = level_of_detail, .classify = classify};
    switch (quality) {
        case Quality::draft:
            sampling.resolution = 0.5;
            break;
        case Quality::high:
            sampling.resolution = 1.5;
            sampling.slice_exponent = -1;
            break;
        case Quality::normal:
            sampling.finer_magnified = true;
            break;
    }
    return sampling;
}

SliceMap Factorisation::slice_map(const Face& face, double w) const {
    const int u = face.u_axis();
    const int v = face.v_axis();
    if (projection == Projection::perspective) {
        const double depth = w - eye[face.axis];
        return {eye[u] + face.origin.x * depth, face.pitch.x * depth, eye[v] + face.origin.y * depth,
                face.pitch.y * depth};
    }
    const double shear = w / direction[face.axis];
    return {face.origin.x + direction[u] * shear, face.pitch.x, face.origin.y + direction[v] * shear,
            face.pitch.y};
}

double Factorisation::step(const Face& face, double i, double j) const {
    Vec3 between = direction / direction[face.axis];
    if (projection == Projection::perspective) {
        between[face.axis] = 1;
        between[face.u_axis()] = face.origin.x + i * face.pitch.x;
        between[face.v_axis()] = face.origin.y + j * face.pitch.y;
    }
    return glm::length(between * lattice.spacing) * slice_pitch();
}

PixelRange pixels_between(double offset, double scale, double lo, double hi, bool closed, int count) {
    const auto from_lo = [lo](double u) { return u >= lo; };
    const auto past_hi = [hi, closed](double u) { return closed ? u > hi : u >= hi; };
    if (scale > 0) {
        return {first_reaching(offset, scale, lo, count, from_lo),
                first_reaching(offset, scale, hi, count, past_hi)};
    }
    return {first_reaching(offset, scale, hi, count, [&](double u) { return !past_hi(u); }),
            first_reaching(offset, scale, lo, count, [&](double u) { return !from_lo(u); })};
}

SliceRange slices_in_front(const Factorisation& factorisation, const Face& face, std::int64_t lo,
                           std::int64_t hi) {
    const double pitch = factorisation.slice_pitch();
    const double first = std::ceil(static_cast<double>(lo) / pitch);
    const double last = std::floor(static_cast<double>(hi) / pitch);
    SliceRange slices{static_cast<std::int64_t>(first), static_cast<std::int64_t>(last)};
    if (factorisation.projection == Projection::perspective) {
        // The eye may be anywhere: clamp before the cast.
        const double eye = std::clamp(factorisation.eye[face.axis] / pitch, first - 2, last + 2);
        if (face.sign > 0) {
            slices.first = std::max(slices.first, static_cast<std::int64_t>(std::floor(eye)) + 1);
        } else {
            slices.last = std::min(slices.last, static_cast<std::int64_t>(std::ceil(eye)) - 1);
        }
    }
    return slices;
}

Rect window_of(const Factorisation& factorisation, const Face& face, const volume::Box& box) {
    const SliceRange slices = slices_in_front(factorisation, face, box.lo[face.axis], box.hi[face.axis]);
    if (slices.empty()) {
        return {};
    }
    // A voxel plane's place in the image changes one way only from slice to slice: the two end slices
    // bound them all.
    Rect window;
    for (const std::int64_t k : {slices.first, slices.last}) {
        const SliceMap map = factorisation.slice_map(face, factorisation.slice_place(k));
        const auto along = [&](int axis, double offset, double scale, int count) {
            return pixels_between(offset, scale, static_cast<double>(box.lo[axis]),
                                  static_cast<double>(box.hi[axis]), true, count);
        };
        const PixelRange u = along(face.u_axis(), map.u_offset, map.u_scale, face.width);
        const PixelRange v = along(face.v_axis(), map.v_offset, map.v_scale, face.height);
        if (k == slices.first) {
            window = {u.first, v.first, u.last, v.last};
        } else {
            window = {std::min(window.x0, u.first), std::min(window.y0, v.first), std::max(window.x1, u.last),
                      std::max(window.y1, v.last)};
        }
    }
    return window.empty() ? Rect{} : window;
}

base::Status validate_crop(const volume::Box& crop, const volume::Index3& n) {
    const auto refuse_crop = [](std::string detail) {
        return base::error(base::Code::invalid_argument, "crop the cube", std::move(detail));
    };
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        if (crop.lo[a] < 0 || crop.hi[a] > n[a] - 1) {
            return refuse_crop("voxels " + std::to_string(crop.lo[a]) + " to " + std::to_string(crop.hi[a]) +
                               " along axis " + std::to_string(axis + 1) + " are not within 0 to " +
                               std::to_string(n[a] - 1));
        }
        if (crop.lo[a] >= crop.hi[a]) {
            return refuse_crop("at least two voxels are wanted along axis " + std::to_string(axis + 1) +
                               ", the lower index first");
        }
    }
    return {};
}

volume::Box widened_to_nodes(const volume::Box& crop, int level, const volume::Index3& n) {
    const std::int64_t pitch = std::int64_t{1} << level;
    volume::Box wide = crop;
    for (std::size_t a = 0; a < 3; ++a) {
        wide.lo[a] = crop.lo[a] / pitch * pitch;
        wide.hi[a] = std::min((crop.hi[a] + pitch - 1) / pitch * pitch, n[a] - 1);
    }
    return wide;
}

base::Status validate(const Factorisation& factorisation) {
    const Lattice& lattice = factorisation.lattice;
    const bool spaced =
        finite(lattice.spacing) && lattice.spacing.x > 0 && lattice.spacing.y > 0 && lattice.spacing.z > 0;
    if (!spaced || *std::min_element(lattice.n.begin(), lattice.n.end()) < 2 ||
        volume::voxel_count(lattice.n) < 0) {
        return refuse_factorisation("its lattice is not one");
    }
    if (!finite(factorisation.eye) || !finite(factorisation.direction)) {
        return refuse_factorisation("its eye or direction is not finite");
    }
    if (factorisation.crop) {
        if (auto status = validate_crop(*factorisation.crop, lattice.n); !status) {
            return status;
        }
    }
    if (factorisation.slice_exponent < -1 ||
        factorisation.slice_exponent > volume::coarsest_level(lattice.n)) {
        return refuse_factorisation(
            "its slices are closer than half a voxel, or of a level that the cube does not have");
    }
    if (factorisation.classify == Classify::pre_integrated &&
        factorisation.level() > volume::max_margin_level) {
        return refuse_factorisation("so coarse a level is not for pre-integrated classification");
    }
    if (!(factorisation.opaque > 0 && factorisation.opaque < 1)) {
        return refuse_factorisation("the opacity at which its rays are done is not between 0 and 1");
    }
    if (factorisation.faces.size() > Factorisation::max_faces) {
        return refuse_factorisation("it has more than six faces");
    }
    std::int64_t area = 0;
    for (const Face& face : factorisation.faces) {
        if (!valid(face)) {
            return refuse_factorisation("a face is out of range");
        }
        area += std::int64_t{face.width} * face.height;
        if (factorisation.projection == Projection::parallel &&
            !(face.sign * factorisation.direction[face.axis] > 0)) {
            return refuse_factorisation("a face looks away from the direction of its rays");
        }
    }
    return area <= Factorisation::max_area ? base::Status{}
                                           : refuse_factorisation("its faces have too many pixels");
}

}  // namespace shearwater::view
