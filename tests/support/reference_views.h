#pragma once
// Views that find faults: far, near and inside, along axes and diagonals, over the poles.

#include <string>
#include <vector>

#include "common/base/workers.h"
#include "common/image/image.h"
#include "common/view/camera.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/render.h"
#include "tests/support/reference_cubes.h"

namespace shearwater::test {

struct NamedView {
    std::string name;
    view::Camera camera;
};

// From outside and inside, 6 kinds for each of 7 directions: 42 of them, or every n-th (5 gives all kinds).
std::vector<NamedView> all_views(const view::Lattice& lattice, std::size_t every = 1);
// Those of one direction, in degrees.
std::vector<NamedView> views_from(const view::Lattice& lattice, double azimuth, double elevation);

// Factorised, rendered and warped: the engine's own picture.
image::Image<image::RgbaF> picture_of(const shear::BrickVolume& volume, const view::Lattice& lattice,
                                      const view::TransferFunction& tf, const view::Camera& camera,
                                      const view::ImageSize& size, base::Workers& workers,
                                      const view::Sampling& sampling = {});

// As a picture on black is shown.
image::Image<image::Rgba8> in_8_bits(const image::Image<image::RgbaF>& picture);

// A ramp from (0.1, 0) to (1, opacity), inferno.
view::TransferFunction ramp_to(double opacity);

// A cube with all it takes to draw it in both ways.
struct Scene {
    FloatCube cube;
    view::Vec3 spacing{1, 1, 1};
    volume::Mapping mapping{};
    view::TransferFunction tf = ramp_to(0.15);

    view::Lattice lattice() const { return {cube.n(), spacing}; }
};

// How near the engine's picture comes to the ray caster's, as they are shown, in dB.
struct Match {
    double at_normal, at_high;
};
Match match(Scene& scene, const view::Camera& camera, const view::ImageSize& size);

}  // namespace shearwater::test
