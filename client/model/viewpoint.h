#pragma once
// Where a person looks from, and how mouse and keys change it.

#include "common/view/camera.h"

namespace shearwater::model {

// An orbit about a target. One number, the distance, sets the scale of both projections, so that switching
// between them keeps the picture's size: the parallel height is 2 distance sin(fov / 2).
struct Viewpoint {
    view::Orbit orbit;  // distance 0: the whole cube is seen
    view::Projection projection = view::Projection::perspective;
    double fov = 30;  // vertical, degrees

    bool operator==(const Viewpoint& other) const;
};

constexpr double min_fov = 5;
constexpr double max_fov = 120;

view::Camera camera(const Viewpoint& viewpoint, const view::Lattice& lattice);

// Lengths (dx, dy) are pixels of a picture of the given size, y downwards.

// A drag over the picture's height turns by half a circle. The poles are never crossed.
void drag_orbit(Viewpoint& viewpoint, double dx, double dy, const view::ImageSize& size);
// Moves the target in the picture's plane, so that what is at the target's depth follows the mouse.
void pan(Viewpoint& viewpoint, double dx, double dy, const view::ImageSize& size,
         const view::Lattice& lattice);
// Multiplies the distance, within limits; the point at the target's depth under (x, y) stays there.
void zoom(Viewpoint& viewpoint, double factor, double x, double y, const view::ImageSize& size,
          const view::Lattice& lattice);
void toggle_projection(Viewpoint& viewpoint);
// Changes the field of view and the distance with it, so that the target keeps its size.
void set_fov(Viewpoint& viewpoint, double fov, const view::Lattice& lattice);

}  // namespace shearwater::model
