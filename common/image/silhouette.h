#pragma once
// The outline of what is shown of the cube in a face's intermediate image. It is convex, so a row crosses it
// in one stretch.

#include <vector>

#include "common/view/factorisation.h"

namespace shearwater::image {

// Pixels i of a row, fractional, whose rays meet it; none where hi < lo.
struct Stretch {
    double lo, hi;
    bool contains(double i) const { return lo <= i && i <= hi; }
};

class Silhouette {
  public:
    Silhouette(const view::Factorisation& factorisation, const view::Face& face);

    // Of row j, which may lie between two rows of pixels.
    Stretch row(double j) const;
    // Of a row of pixels from 2 above the face to 2 below it.
    const Stretch& pixel_row(int j) const { return rows_[static_cast<std::size_t>(j + reach)]; }
    static constexpr int reach = 2;
    // Whether a place's ray meets the cube: row(j).contains(i), mostly without working row(j) out. The place
    // is in the face or less than a pixel from it.
    bool contains(double i, double j) const;

  private:
    const view::Factorisation& factorisation_;
    const view::Face& face_;
    std::vector<Stretch> rows_;
};

}  // namespace shearwater::image
