#pragma once
// An edge of a box as a picture shows it, and an axis' values along it.

#include <optional>
#include <vector>

#include "common/view/camera.h"
#include "common/volume/box.h"
#include "common/wcs/axis.h"

namespace shearwater::model {

struct Edge {
    int along = 0;            // its axis
    view::Vec3 from{}, to{};  // voxels; to is farther along the axis
    view::Vec3 at(double t) const { return from + t * (to - from); }
};

// The edges of the box's outline in the picture: of the two faces that meet there one is seen. None where the
// eye is inside.
std::vector<Edge> outline(const view::Camera& camera, const view::ImageSize& size,
                          const view::Lattice& lattice, const volume::Box& box);

// The longest part of an edge in the picture: t from first to last.
struct Part {
    double first = 0, last = 0;
    view::Vec2 from{}, to{};  // pixels
};
std::optional<Part> part_in_picture(const Edge& edge, const view::Camera& camera, const view::ImageSize& size,
                                    const view::Lattice& lattice);

// Where along a part of an edge the axis takes on multiples of a step, by rising t; at most `most` of them.
struct Crossing {
    double t = 0;
    double value = 0;
};
std::vector<Crossing> crossings(const Edge& edge, const Part& part, const wcs::Axis& axis,
                                const volume::Index3& n, double step, std::size_t most);
// How far apart the axis' least and largest values along the part are; 0 where there are none.
double extent(const Edge& edge, const Part& part, const wcs::Axis& axis, const volume::Index3& n);

}  // namespace shearwater::model
