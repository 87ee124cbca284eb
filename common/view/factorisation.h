#pragma once
// The shear-warp factorisation of one view (DVR 2.2; Lacroute & Levoy 1994), computed once per frame at
// the head and used by all.
//
//   slice k of a face            intermediate image                  picture
//   (u, v) voxel coordinates --- pixel (i, j) of the face --- warp --- pixel (px, py)
//
// A face has a principal axis w; u = (w + 1) % 3 and v = (w + 2) % 3 are its in-plane axes. Slice k is the
// plane of samples at w = k * slice_pitch: a plane of voxels, or one half-way between two, or, where voxels
// are small in the picture, a plane of the nodes of a coarser level of the cube. The ray of intermediate
// pixel (i, j) meets it at
//   perspective   u = eye_u + (origin_u + i * pitch_u) * (w - eye_w)     "slopes": the cube around the eye
//   parallel      u = (origin_u + i * pitch_u) + slope_u * w             positions on slice 0
// and the same for v with j. Both are  u = offset(w) + scale(w) * i.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/view/camera.h"
#include "common/volume/box.h"

namespace shearwater::view {

// Half-open rectangle of intermediate or output pixels.
struct Rect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool operator==(const Rect&) const = default;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    std::int64_t area() const { return empty() ? 0 : static_cast<std::int64_t>(width()) * height(); }
    bool empty() const { return x1 <= x0 || y1 <= y0; }
};
inline Rect intersection(const Rect& a, const Rect& b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}
Rect bounding(const Rect& a, const Rect& b);  // an empty one counts for nothing
// What of a rectangle another leaves over: up to four, some of them empty.
std::array<Rect, 4> left_over(const Rect& whole, const Rect& part);

enum class Quality { draft, normal, high };
// Where along a ray the transfer function is applied.
enum class Classify {
    post,            // to each sample after interpolation
    pre_integrated,  // to all values between two samples, in advance (Engel, Kraus & Ertl 2001)
};
// A ray with so much opacity is done, where nothing else is wanted, and as good as opaque: what is left of its
// light is well below half a level of 255.
inline constexpr float opaque_enough = 1 - 1.0F / 4096;
// How densely rays are sampled, and how far. Opacity does not depend on it, but by what a ray that is done
// leaves out.
struct Sampling {
    double resolution = 1;         // intermediate pixels per output pixel along a side
    int slice_exponent = 0;        // slices lie 2^slice_exponent voxels apart: 0, or -1 for half a voxel
    bool level_of_detail = false;  // or more, where voxels are smaller than intermediate pixels
    bool finer_magnified = false;  // or half a voxel, where nearer voxels span more than 1.25 of them
    Classify classify = Classify::post;
    double opaque = opaque_enough;  // the opacity at which a ray is done, less than 1

    bool operator==(const Sampling&) const = default;
};
// draft: half the resolution; normal: two slices a voxel only close up; high: one and a half times the
// resolution, and two slices a voxel.
Sampling sampling(Quality quality, bool level_of_detail = false, Classify classify = Classify::post);

struct Face {
    int axis = 2;   // principal axis w
    int sign = 1;   // slices are visited by rising k (+1) or falling k (-1), front to back
    int width = 0;  // of the intermediate image, pixels
    int height = 0;
    Vec2 origin{};  // of pixel (0, 0), along u and v
    Vec2 pitch{};   // per pixel, along u and v
    bool operator==(const Face&) const = default;

    int u_axis() const { return (axis + 1) % 3; }
    int v_axis() const { return (axis + 2) % 3; }
};

// Where a plane's voxels lie under a face's pixels: u = u_offset + u_scale * i, v likewise with j.
struct SliceMap {
    double u_offset, u_scale, v_offset, v_scale;
};

struct Factorisation {
    static constexpr int max_faces = 6;
    static constexpr int max_side = 16384;  // pixels of a face's side
    // Pixels of all faces: as many as travel in 2^30 bytes, with what their rows take besides.
    static constexpr std::int64_t max_area = (std::int64_t{1} << 27) - (std::int64_t{1} << 17);

    Projection projection = Projection::perspective;
    Lattice lattice;
    // Voxel space: the eye (perspective), or the direction that rays go (parallel).
    Vec3 eye{};
    Vec3 direction{};
    int slice_exponent = 0;  // as in Sampling, or the level of detail (volume/levels.h)
    Classify classify = Classify::post;
    double opaque = opaque_enough;  // as in Sampling; rays end by themselves in each sub-volume
    std::vector<Face> faces;
    // What is drawn of the cube, the faces of the box included; else all of it. The picture is that of a cube
    // that ends there: no sample lies outside, and what a ray's first and last samples stand for reaches to
    // where it enters and leaves the box. Values are interpolated between all voxels all the same.
    std::optional<volume::Box> crop = {};

    bool operator==(const Factorisation&) const = default;

    volume::Box shown() const { return crop.value_or(volume::whole(lattice.n)); }
    int level() const { return slice_exponent > 0 ? slice_exponent : 0; }
    double slice_pitch() const {
        return slice_exponent < 0 ? 0.5 : 1 << level();
    }  // voxels from slice to slice
    double slice_place(std::int64_t k) const { return static_cast<double>(k) * slice_pitch(); }
    // Of the plane at w, in voxels along the face's axis.
    SliceMap slice_map(const Face& face, double w) const;
    // World length of the ray of pixel (i, j) between two slices.
    double step(const Face& face, double i, double j) const;
};

// The faces that the picture needs, each just large enough for its part of the picture and of what is shown
// of the cube, and one level of detail for all: that whose voxels are nearest to an intermediate pixel where
// they are largest, unless what is shown is thinner than a few of its nodes. The camera, size and crop are
// valid.
Factorisation factorise(const Camera& camera, const ImageSize& size, const Lattice& lattice,
                        const Sampling& sampling, const std::optional<volume::Box>& crop = {});
// The same of the cameras of one frame, on one level of detail, the finest that one of them wants: what two
// eyes see is to be alike.
std::vector<Factorisation> factorise(std::span<const Camera> cameras, const ImageSize& size,
                                     const Lattice& lattice, const Sampling& sampling,
                                     const std::optional<volume::Box>& crop = {});

// Half-open range of pixels along one side of a face.
struct PixelRange {
    int first = 0, last = 0;
    bool operator==(const PixelRange&) const = default;
    bool empty() const { return last <= first; }
};
// The pixels i in [0, count) with lo <= offset + scale * i < hi, or <= hi where `closed`. Whoever asks
// gets the very same answer, so ranges that meet at a plane neither share a pixel nor leave one out.
PixelRange pixels_between(double offset, double scale, double lo, double hi, bool closed, int count);

// The slices of a face that lie in the voxels [lo, hi] and in front of the eye: [first, last], empty if
// last < first. In a parallel view all are in front.
struct SliceRange {
    std::int64_t first = 0, last = -1;
    bool operator==(const SliceRange&) const = default;
    bool empty() const { return last < first; }
};
SliceRange slices_in_front(const Factorisation& factorisation, const Face& face, std::int64_t lo,
                           std::int64_t hi);

// Refuses a box to crop a cube of n voxels to that is not inside it, or has no thickness along some axis.
base::Status validate_crop(const volume::Box& crop, const volume::Index3& n);
// The box with its faces moved out to planes of a level's nodes, as far as the cube goes: between them a
// coarse level has samples, however thin the box.
volume::Box widened_to_nodes(const volume::Box& crop, int level, const volume::Index3& n);

// The pixels of a face that rays through the (closed) box can reach: its window (DVR 3.4).
Rect window_of(const Factorisation& factorisation, const Face& face, const volume::Box& box);

// Whether a peer's factorisation keeps the limits above and is finite throughout.
base::Status validate(const Factorisation& factorisation);

// Front-to-back order of boxes that cuts across one axis (or a tree of such cuts) made disjoint: indices
// into `boxes`, the nearest first. One order serves every face.
std::vector<int> visibility_order(const Factorisation& factorisation, const std::vector<volume::Box>& boxes);

}  // namespace shearwater::view
