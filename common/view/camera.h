#pragma once
// The camera of design section 3: x to the right, y up, row 0 of the picture on top.
//
// The projection plane is square to the line from the eye to the target. The ray of the picture's middle goes
// along that line, or, off its axis, along  forward + slant.x * right + slant.y * up:  in perspective the
// picture's middle is shifted in the projection plane by so much of the plane's distance (an asymmetric
// frustum), in a parallel view all rays meet the plane aslant (a sheared one).

#include "common/base/result.h"
#include "common/view/geometry.h"

namespace shearwater::view {

struct ImageSize {
    int width = 512;
    int height = 512;
    bool operator==(const ImageSize&) const = default;
};

enum class Projection { perspective, parallel };

struct Camera {
    Vec3 eye{0, 0, 1};  // world
    Vec3 target{0, 0, 0};
    Vec3 up{0, 1, 0};
    Projection projection = Projection::perspective;
    double fov = 30;    // vertical field of view in degrees, perspective only
    double height = 1;  // world height of the picture, parallel only
    Vec2 slant{0, 0};   // of the picture's middle: tangents, at most max_slant long

    static constexpr double max_slant = 10;
    bool operator==(const Camera&) const = default;
};

// Angles and distance about a target: eye = target + distance * (sin az cos el, sin el, cos az cos el).
struct Orbit {
    double azimuth = 30;  // degrees
    double elevation = 20;
    double distance = 0;  // 0: far enough that the whole cube is seen
    Vec3 target{0, 0, 0};
    double roll = 0;  // degrees that the camera leans to its right, so that the picture turns to the left

    bool operator==(const Orbit&) const = default;
};

// Where the sides of an orbit's picture point in world space: unit vectors, square to one another.
struct PictureAxes {
    Vec3 right, up, back;  // back: towards the eye
};
PictureAxes picture_axes(const Orbit& orbit);

// The camera of an orbit. A height or distance of 0 becomes the design's default for the lattice:
// distance = (diagonal / 2) / sin(fov / 2), height = diagonal.
Camera camera_on(const Orbit& orbit, const Lattice& lattice, Projection projection = Projection::perspective,
                 double fov = 30, double height = 0);

// Directions of a valid camera's picture in world space, each of unit length and square to the others.
struct Axes {
    Vec3 right, up, forward;
};
Axes axes_of(const Camera& camera);
// World height of what the picture shows in the plane at so much depth, square to forward, in front of the
// eye.
double height_at(const Camera& camera, double depth);

// The rays of a picture in world space: pixel (x, y)'s centre lies at (x + 0.5, y + 0.5).
// perspective: a ray starts at `origin` and goes along dir + px * dir_x + py * dir_y;
// parallel: it goes along `dir` through origin + px * origin_x + py * origin_y, and begins nowhere.
struct Rays {
    Projection projection;
    Vec3 origin, origin_x, origin_y;
    Vec3 dir, dir_x, dir_y;

    Vec3 origin_at(double px, double py) const { return origin + px * origin_x + py * origin_y; }
    Vec3 direction_at(double px, double py) const { return dir + px * dir_x + py * dir_y; }
};

Rays rays_of(const Camera& camera, const ImageSize& size);
// The same rays in voxel space (directions are not of unit length in either).
Rays in_voxel_space(const Rays& world, const Lattice& lattice);

// Refuses what is not finite, a fov outside (0, 180), a height or size out of range (at most 8192 pixels
// a side and 2^25 in all), an eye on its target, an up along the line of sight, and too long a slant.
base::Status validate(const Camera& camera, const ImageSize& size);

}  // namespace shearwater::view
