#pragma once
// Cubes and views for tests of whole trees.

#include <random>
#include <string>
#include <vector>

#include "common/fits/cube.h"
#include "common/image/warp.h"
#include "deploy/samples/sample.h"
#include "protocol/wire/convert.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/render.h"
#include "tests/support/temporary_folder.h"

namespace shearwater::support {

// Twenty views of a cube, reproducible: parallel and perspective, eye far, near and inside, odd sizes.
inline std::vector<wire::View> twenty_views(const view::Lattice& lattice) {
    std::mt19937 random(20);
    const auto within = [&](double lo, double hi) {
        return std::uniform_real_distribution<double>(lo, hi)(random);
    };
    std::vector<wire::View> views;
    for (int i = 0; i < 20; ++i) {
        wire::View v;
        const double diagonal = lattice.diagonal();
        // Far, near, inside, and parallel in turn.
        const double distance = i % 4 == 0 ? 3 * diagonal : i % 4 == 1 ? 0.6 * diagonal : 0.12 * diagonal;
        view::Orbit orbit{
            .azimuth = within(0, 360), .elevation = within(-85, 85), .distance = distance, .target = {}};
        orbit.target = {within(-2, 2), within(-2, 2), within(-2, 2)};
        const bool parallel = i % 4 == 3;
        v.camera = view::camera_on(orbit, lattice,
                                   parallel ? view::Projection::parallel : view::Projection::perspective,
                                   i % 4 == 2 ? 80 : 30, parallel ? within(0.3, 1.2) * diagonal : 0);
        v.size = {.width = 131 + i, .height = 97 + 2 * i};
        v.quality = i % 3 == 0   ? view::Quality::high
                    : i % 3 == 1 ? view::Quality::normal
                                 : view::Quality::draft;
        v.deflate = i % 2 == 0;
        v.classify = i / 4 % 2 == 0 ? view::Classify::post : view::Classify::pre_integrated;
        v.tf = view::default_transfer_function();
        v.tf.opacity_pins = {view::Ramp{.x0 = 0.1, .a0 = 0, .x1 = 1, .a1 = i % 5 == 0 ? 0.9 : 0.15}};
        views.push_back(std::move(v));
    }
    return views;
}

// The truth a tree is compared with: the whole cube in one piece, in this process.
class Single {
  public:
    Single(const std::string& path, const volume::Mapping& mapping, view::Vec3 spacing = {1, 1, 1})
        : volume_(load(path, mapping, workers_)), lattice_{.n = volume_.cube(), .spacing = spacing} {}

    // Of one eye.
    image::Image<image::Rgba8> draw(const wire::View& v) {
        const auto factorisation =
            view::factorise(v.camera, v.size, lattice_,
                            view::sampling(v.quality, v.level_of_detail.value_or(true), v.classify), v.crop);
        const auto windows = shear::render(volume_, factorisation, v.tf, workers_).windows;
        return image::warp(factorisation, windows, v.camera, v.size, v.tf.background, workers_);
    }
    const view::Lattice& lattice() const { return lattice_; }

  private:
    static shear::BrickVolume load(const std::string& path, const volume::Mapping& mapping,
                                   base::Workers& workers) {
        auto cube = fits::Cube::open(path);
        base::check(cube.has_value(), "the test's cube opens");
        auto volume =
            shear::BrickVolume::load(*cube, volume::whole(cube->info().n), cube->info().n, mapping, workers);
        base::check(volume.has_value(), "the test's cube loads");
        return *std::move(volume);
    }

    base::Workers workers_;
    shear::BrickVolume volume_;
    view::Lattice lattice_;
};

}  // namespace shearwater::support
