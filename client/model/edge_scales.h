#pragma once
// Ticks with values along the edges of the box that is shown, as a picture shows it: where, and what is
// written.
//
//        |                           an edge of the outline; what is shown lies on one side of it,
//   1h  -+   tick                    ticks and labels on the other
//        |
//        +---+----+-
//           10   20

#include <functional>
#include <string>
#include <vector>

#include "common/view/camera.h"
#include "common/volume/box.h"
#include "common/wcs/axis.h"

namespace shearwater::model {

// A rectangle of the picture, in its pixels, y downwards.
struct Plate {
    view::Vec2 from, size;

    bool overlaps(const Plate& other, double gap) const;
};

struct EdgeScale {
    struct Mark {
        view::Vec2 from, to;  // outwards from the edge
    };
    struct Label {
        Plate plate;
        std::string text;
    };
    int along = 0;  // which of the cube's axes
    std::vector<Mark> marks;
    std::vector<Label> labels;  // of some or all marks; the last one is that of the axis, if `titled`
    bool titled = false;
};

// How large things are, in the picture's pixels.
struct ScaleStyle {
    double mark = 5, gap = 4;
    std::function<view::Vec2(const std::string&)> size_of;  // of a text
    std::vector<Plate> reserved;                            // no label may lie over these
};

// One for each axis of which an edge of the outline is seen long enough. No label lies over another, over the
// box or outside of the picture. Where the header says nothing of an axis, it counts voxels. The camera and
// the size are valid, the box lies in the lattice.
std::vector<EdgeScale> edge_scales(const view::Camera& camera, const view::ImageSize& size,
                                   const view::Lattice& lattice, const volume::Box& box,
                                   const wcs::Axes& world, const ScaleStyle& style);

}  // namespace shearwater::model
