#pragma once
// The parts in which a frame's intermediate images are rendered, travel and are merged, one behind the other,
// so that the first are on their way while the last are still drawn.
//
//   face whose axis is 0 or 2          face whose axis is 1
//   +-----------+                      +---+---+---+
//   |  band 0   |                      |   |   |   |
//   +-----------+                      | 0 | 1 | 2 |
//   |  band 1   |                      |   |   |   |
//   +-----------+                      +---+---+---+
//
// Voxels are adjacent along axis 0, and bands run along it, or along the axis that is turned to lie so, as
// the rows do that a renderer goes along.

#include <cstddef>
#include <vector>

#include "common/view/factorisation.h"

namespace shearwater::view {

struct Band {
    static constexpr int per_face = 8;  // about; at most most_per_face
    static constexpr int most_per_face = 10;
    // Neither fewer lines, but for the last, nor fewer pixels: a message is to be worth its while.
    static constexpr int least_lines = 64;
    static constexpr std::int64_t least_pixels = std::int64_t{1} << 15;
    static constexpr int line_step = 32;  // lines go in so many, as a renderer's tiles do

    int face = 0;  // index into Factorisation::faces
    Rect rect;     // of the face's pixels
    bool operator==(const Band&) const = default;
};

// All bands of a frame, face by face. They cover every face once. Every node cuts at the same lines, for they
// depend on the factorisation alone.
std::vector<Band> bands_of(const Factorisation& factorisation);

}  // namespace shearwater::view
