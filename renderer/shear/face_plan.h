#pragma once
// What the tiles of one face share in a frame: where each slice lies in the face's image, and the length that
// each sample stands for.
//
// Voxels are adjacent along axis 0. A face is rendered in rows along its fast axis, the in-plane one whose
// voxels are adjacent, or will be once they are turned (axis 0 being the principal one); the other is its
// slow axis. All rectangles and pixels here are turned the same way: x and i along the fast axis, y and j
// along the slow one.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/view/factorisation.h"
#include "renderer/shear/axis_clip.h"
#include "renderer/shear/brick_volume.h"

namespace shearwater::shear {

// A slice that the sub-volume owns, in the nodes of the level that is drawn.
struct SlicePlan {
    view::SliceMap map;  // where nodes lie under pixels, fast as u and slow as v
    view::Rect owned;    // the pixels whose samples the sub-volume owns
    view::Rect whole;    // those whose samples stand for a whole step
};

// Lengths on the rays of a face's pixels, of whole steps and of what samples stand for instead.
struct RayLengths {
    const float* steps;     // from pixel (x0, y0) on
    float* lengths;         // that are written, likewise
    std::ptrdiff_t stride;  // of both, from row to row
    int x0, y0;

    std::ptrdiff_t offset(int x, int y) const { return (y - y0) * stride + (x - x0); }
};

class FacePlan {
  public:
    FacePlan(const BrickVolume& volume, const view::Factorisation& factorisation, int face_index);

    const view::Face& face() const { return face_; }
    const view::Factorisation& factorisation() const { return factorisation_; }
    int fast_axis() const { return turned() ? face_.v_axis() : face_.u_axis(); }
    int slow_axis() const { return turned() ? face_.u_axis() : face_.v_axis(); }
    // Whether rows run along v, so that the face's image is the transpose of what is rendered.
    bool turned() const { return face_.axis == 1; }
    view::Rect turn(const view::Rect& rect) const {
        return turned() ? view::Rect{rect.y0, rect.x0, rect.y1, rect.x1} : rect;
    }
    // The pixels that the sub-volume may reach.
    const view::Rect& window() const { return window_; }

    // The slices that the sub-volume owns and that are in front of the eye, front to back: the n-th's number.
    std::int64_t slice_count() const { return slices_.last - slices_.first + 1; }
    std::int64_t slice(std::int64_t n) const { return face_.sign > 0 ? slices_.first + n : slices_.last - n; }
    const SlicePlan& slice_plan(std::int64_t k) const { return plans_[slot(k)]; }

    // The level of detail that is drawn, and in its nodes where slice k lies along the face's axis, and where
    // the nodes of the plane at `place` lie under pixels, fast as u and slow as v.
    int level() const { return factorisation_.level(); }
    float opaque() const { return static_cast<float>(factorisation_.opaque); }
    double node_place(std::int64_t k) const { return factorisation_.slice_place(k) * nodes_per_voxel_; }
    view::SliceMap node_map(double place) const;
    // Whether all slices lie on planes of nodes.
    bool on_planes() const;
    // World lengths between two slices of the rays of pixels of row j from i on.
    void steps(int i, int j, std::span<float> out) const;
    // "The cube" is what is shown of it (Factorisation::crop).
    // The pixels whose rays meet slice k inside the cube; none where k is behind the eye.
    const view::Rect& inside(std::int64_t k) const;
    // Of some pixels, all inside(k), steps times how many slice distances the samples of slice k stand for on
    // their rays. A sample stands for the half distances to both sides; the first and the last on a ray reach
    // to where the ray enters and leaves the cube, so that together they cover it exactly.
    void write_shares(std::int64_t k, const view::Rect& pixels, const RayLengths& lengths) const;

    // Of segments from slice to slice (segments.h). The slice behind k; its pixels are inside() too.
    std::int64_t behind(std::int64_t k) const { return k + face_.sign; }
    std::int64_t before(std::int64_t k) const { return k - face_.sign; }
    // Steps times how many slice distances the rays of some pixels have in the cube between slice k, which
    // they all meet inside it, and the one before or behind it, which they do not.
    void write_entries(std::int64_t k, const view::Rect& pixels, const RayLengths& lengths) const {
        write_rims(k, -face_.sign, pixels, lengths);
    }
    void write_exits(std::int64_t k, const view::Rect& pixels, const RayLengths& lengths) const {
        write_rims(k, face_.sign, pixels, lengths);
    }
    // The pixels whose rays move sideways by no more than a voxel from plane to plane.
    const view::Rect& gentle() const { return gentle_; }

  private:
    std::pair<double, double> line_of(int axis) const;
    double place_of(int axis, int pixel) const;
    view::SliceMap slice_map(double w) const;
    bool closed(const volume::Box& box, int axis) const;
    volume::Box shown_of(const volume::Box& box) const;
    view::SliceRange owned_slices(const volume::Box& box) const;
    void lay_slice(const volume::Box& box, std::int64_t k);
    view::Rect gentle_rays() const;
    Stretch of_row(int j) const;
    template <class Steps>
    void write(const view::Rect& pixels, const RayLengths& lengths, const Steps& steps) const;
    void write_rims(std::int64_t k, int sign, const view::Rect& pixels, const RayLengths& lengths) const;
    std::size_t slot(std::int64_t k) const { return static_cast<std::size_t>(k - slices_.first); }
    bool perspective() const { return factorisation_.projection == view::Projection::perspective; }

    const view::Factorisation& factorisation_;
    const view::Face& face_;
    double nodes_per_voxel_;
    volume::Box shown_;          // of the cube
    volume::Index3 last_voxel_;  // of the cube
    view::Rect window_, gentle_;
    std::vector<Stretch> rows_;     // what all rays of a row of the window are within, inside the cube
    std::vector<Stretch> columns_;  // and of a column, whatever the row
    view::SliceRange slices_;       // that the sub-volume owns, in front of the eye
    AxisClip fast_clip_, slow_clip_;
    std::vector<SlicePlan> plans_;
    std::vector<view::Rect> inside_;  // of the slices and of one more at either end
};

}  // namespace shearwater::shear
