#pragma once
// The truth that pictures are compared with: a ray caster that follows the design's section 3 and shares
// no rendering code with the engine, only the camera's rays and the transfer function's evaluation.

#include "common/base/workers.h"
#include "common/image/image.h"
#include "common/view/camera.h"
#include "common/view/transfer_function.h"
#include "common/volume/mapping.h"
#include "tests/support/reference_cubes.h"

namespace shearwater::test {

// Premultiplied, with alpha, row 0 first. Every ray is cut, from where it enters the cube (or from the
// eye) to where it leaves, into equal pieces of at most `piece` voxels, each sampled at its middle:
// trilinear in s of the float data; a sample whose valid voxels weigh less than one half is transparent,
// else it is their mean.
image::Image<image::RgbaF> cast_rays(const FloatCube& cube, const view::Vec3& spacing,
                                     const volume::Mapping& mapping, const view::TransferFunction& tf,
                                     const view::Camera& camera, const view::ImageSize& size,
                                     base::Workers& workers, double piece = 0.25);

// What a ray (in voxel space, from its origin on, or from ever on where it begins nowhere) has inside the
// cube: its world length, the slices it advances along its principal axis, and the faces of the cube it
// comes in and goes out by: 2 * axis, + 1 for the upper; -1 where it begins inside or misses the cube.
struct Chord {
    double length = 0;
    double slices = 0;
    int in = -1, out = -1;
};
Chord chord_of(const volume::Index3& n, const view::Vec3& spacing, const view::Vec3& origin,
               const view::Vec3& direction, bool begins);
// The same of the ray through a point of the picture.
Chord chord_of(const volume::Index3& n, const view::Vec3& spacing, const view::Camera& camera,
               const view::ImageSize& size, double px, double py);

// Over r, g, b and a, in dB; images of one size.
double psnr(const image::Image<image::RgbaF>& a, const image::Image<image::RgbaF>& b);
double psnr(const image::Image<image::Rgba8>& a, const image::Image<image::Rgba8>& b);  // without alpha
int largest_difference(const image::Image<image::Rgba8>& a, const image::Image<image::Rgba8>& b);

}  // namespace shearwater::test
