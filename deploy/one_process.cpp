#include "deploy/one_process.h"

#include <chrono>
#include <cstdio>
#include <optional>

#include "common/base/memory.h"
#include "common/cube/open.h"
#include "common/image/warp.h"
#include "common/volume/statistics.h"
#include "renderer/culling/culler.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/render.h"

namespace shearwater::deploy {
namespace {

class Clock {
  public:
    // Seconds since this was made, or last asked.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<double> passed = now - last_;
        last_ = now;
        return passed.count();
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

base::Result<volume::Mapping> mapping_for(cube::Cube& opened, const options::CubeOptions& cube,
                                          base::Workers& workers, const volume::Progress& progress) {
    volume::Mapping mapping{.stretch = cube.stretch_value(), .bits = cube.bits};
    if (cube.range.size() == 2) {
        mapping.lo = cube.range[0];
        mapping.hi = cube.range[1];
        return mapping;
    }
    const auto& n = opened.info.n;
    const auto half = [&](double fraction) { progress(fraction / 2); };
    const auto histogram = volume::count_values(*opened.source, volume::whole(n), n, workers, half);
    if (!histogram) {
        return histogram.error();
    }
    const volume::Limits limits = volume::percentile_limits(*histogram, cube.percentile);
    mapping.lo = limits.lo;
    mapping.hi = limits.hi;
    return mapping;
}

void add(const shear::RenderStats& part, shear::RenderStats& sum) {
    sum.samples += part.samples;
    sum.bricks_total += part.bricks_total;
    sum.bricks_empty += part.bricks_empty;
    sum.bricks_culled += part.bricks_culled;
    sum.bricks_rendered += part.bricks_rendered;
}

}  // namespace

base::Result<Picture> draw_in_process(const options::CubeOptions& cube, const ViewOptions& view,
                                      const view::TransferFunction& tf, int threads, int repeat,
                                      const volume::Progress& progress) {
    base::Workers workers(threads);
    Clock clock;
    auto opened = cube::open(cube.path, cube.open_options());
    if (!opened) {
        return opened.error();
    }
    for (const std::string& note : opened->info.notes) {
        std::fprintf(stderr, "note: %s\n", note.c_str());
    }
    const view::Lattice lattice{.n = opened->info.n, .spacing = cube.spacing_value()};
    const auto size = view.image_size();
    const auto camera = view.camera(lattice);
    const auto crop = view.crop_of(lattice);
    if (!size || !camera || !crop) {
        return !size ? size.error() : !camera ? camera.error() : crop.error();
    }
    const auto mode = view.stereo.mode();
    std::vector<view::Camera> eyes{*camera};
    if (mode) {
        const auto pair = view::eyes_of(*camera, view.stereo.eyes);
        eyes.assign(pair.begin(), pair.end());
    }
    double load = clock.lap();
    const auto mapping = mapping_for(*opened, cube, workers, progress);
    if (!mapping) {
        return mapping.error();
    }
    double preprocess = clock.lap();
    const auto second_half = [&](double fraction) { progress(0.5 + fraction / 2); };
    const auto volume = shear::BrickVolume::load(*opened->source, volume::whole(lattice.n), lattice.n,
                                                 *mapping, workers, second_half);
    if (!volume) {
        return volume.error();
    }
    load += clock.lap();

    Picture picture;
    std::vector<Seconds> times;
    shear::Classifier classifier;
    const culling::Settings culling = view.drawing.culling_settings();
    std::optional<culling::Culler> culler;
    if (culling.kind != culling::Kind::off) {
        const auto level = view::factorise(eyes, *size, lattice, view.sampling(), *crop).front().level();
        culler.emplace(*volume, lattice.spacing);
        culler->prepare(tf, culling.kind, level, workers);
        preprocess += clock.lap();
    }
    for (int i = 0; i < repeat; ++i) {
        clock.lap();
        const auto factorisations = view::factorise(eyes, *size, lattice, view.sampling(), *crop);
        const auto& classification =
            classifier.classify(*volume, tf, factorisations.front().classify, workers);
        Seconds spent{.load = load, .preprocess = preprocess};
        shear::RenderStats stats;
        std::vector<image::Image<image::Rgba8>> pictures;
        for (std::size_t eye = 0; eye < eyes.size(); ++eye) {
            const auto& factorisation = factorisations[eye];
            const auto visible =
                culler ? std::optional(culler->visible(factorisation, tf, culling, workers)) : std::nullopt;
            shear::RenderStats of_eye;
            const auto windows = shear::render(*volume, classification, factorisation, workers, &of_eye, {},
                                               visible ? &*visible : nullptr);
            add(of_eye, stats);
            spent.render += clock.lap();
            pictures.push_back(
                image::warp(factorisation, windows, eyes[eye], *size, tf.background, workers));
            spent.warp += clock.lap();
        }
        picture.image = mode ? image::composed(pictures.front(), pictures.back(), *mode)
                             : std::move(pictures.front());
        spent.total = spent.render + spent.warp;
        times.push_back(spent);
        picture.samples = stats.samples;
        picture.bricks_total = stats.bricks_total;
        picture.bricks_empty = stats.bricks_empty;
        picture.bricks_culled = stats.bricks_culled;
        picture.bricks_rendered = stats.bricks_rendered;
    }
    picture.seconds = median(times);
    picture.each = std::move(times);
    picture.tree = "1,1";
    picture.memory.push_back({"shearwater", base::memory_use().peak});
    return picture;
}

}  // namespace shearwater::deploy
