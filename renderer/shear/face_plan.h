#pragma once
// What the tiles of one face share in a frame: where each slice of each brick lies in the face's image,
// the order to visit bricks in, and the length each sample stands for.

#include <cstdint>
#include <vector>

#include "common/view/factorisation.h"
#include "renderer/shear/brick_volume.h"

namespace shearwater::shear {

class FacePlan {
  public:
    FacePlan(const BrickVolume& volume, const view::Factorisation& factorisation, int face_index);

    int face_index() const { return face_index_; }
    const view::Face& face() const { return face_; }
    const view::Factorisation& factorisation() const { return factorisation_; }
    // The pixels that the sub-volume may reach.
    const view::Rect& window() const { return window_; }

    // Bricks' places along each axis, in an order that is front to back along every ray of the face, the
    // principal axis being the outermost loop.
    const std::vector<std::int64_t>& layers() const { return order_[0]; }
    const std::vector<std::int64_t>& columns() const { return order_[1]; }
    const std::vector<std::int64_t>& rows() const { return order_[2]; }
    // The slices that the bricks of a layer own and that are in front of the eye.
    view::SliceRange slices_of_layer(std::int64_t layer) const;
    // The pixels whose samples on slice k the bricks of a column own along u; of a row, along v.
    const view::PixelRange& pixels_of_column(std::int64_t k, std::int64_t column) const;
    const view::PixelRange& pixels_of_row(std::int64_t k, std::int64_t row) const;

    // The pixels whose rays meet slice k inside the cube; none where k is behind the eye.
    const view::Rect& inside(std::int64_t k) const;
    // How many slice distances the sample of slice k stands for on the ray of a pixel inside(k). A sample
    // stands for the half distances to both sides; the first and the last on a ray reach to where the ray
    // enters and leaves the cube, so that together they cover it exactly.
    double share(std::int64_t k, int i, int j) const;

  private:
    struct Axis;
    void lay_slices(const BrickVolume& volume);
    std::vector<std::int64_t> front_to_back(const BrickVolume& volume, int axis) const;
    std::size_t slot(std::int64_t k) const { return static_cast<std::size_t>(k - slices_.first); }

    const view::Factorisation& factorisation_;
    const view::Face& face_;
    int face_index_;
    volume::Index3 last_voxel_;  // of the cube
    view::Rect window_;
    view::SliceRange slices_;  // that the sub-volume owns, in front of the eye
    std::array<std::vector<std::int64_t>, 3> order_;
    std::vector<view::SliceRange> layers_;
    std::vector<view::PixelRange> columns_, rows_;  // slice by slice
    std::vector<view::Rect> inside_;                // of the slices and of one more at either end
};

}  // namespace shearwater::shear
