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

std::vector<view::Camera> eyes_of(const view::Camera& camera, const StereoOptions& stereo) {
    if (!stereo.mode()) {
        return {camera};
    }
    const auto pair = view::eyes_of(camera, stereo.eyes);
    return {pair.begin(), pair.end()};
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
                                      const Script& script, int threads, const volume::Progress& progress) {
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
    auto shot = script.shot(0, lattice);
    const auto crop = view.crop_of(lattice);
    if (!size || !shot || !crop) {
        return !size ? size.error() : !shot ? shot.error() : crop.error();
    }
    double load = clock.lap();
    const double share = script.pictures > 1 ? 0.5 : 1;  // of the progress, for loading
    const auto loading = [&](double fraction) { progress(share * fraction); };
    const auto mapping = mapping_for(*opened, cube, workers, loading);
    if (!mapping) {
        return mapping.error();
    }
    double preprocess = clock.lap();
    const auto second_half = [&](double fraction) { loading(0.5 + fraction / 2); };
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
        culler.emplace(*volume, lattice.spacing);
    }
    for (int i = 0; i < script.pictures; ++i) {
        if (i > 0) {
            shot = script.shot(i, lattice);
            if (!shot) {
                return shot.error();
            }
        }
        const view::TransferFunction& tf = shot->tf;
        clock.lap();
        const std::vector<view::Camera> eyes = eyes_of(shot->camera, view.stereo);
        const auto factorisations = view::factorise(eyes, *size, lattice, view.sampling(), *crop);
        if (culler) {
            culler->prepare(tf, culling.kind, factorisations.front().level(), workers);
            preprocess += clock.lap();
        }
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
            pictures.push_back(image::warp(factorisation, windows, eyes[eye], *size, tf.background, workers));
            spent.warp += clock.lap();
        }
        const auto mode = view.stereo.mode();
        picture.image =
            mode ? image::composed(pictures.front(), pictures.back(), *mode) : std::move(pictures.front());
        spent.total = spent.render + spent.warp;
        times.push_back(spent);
        if (script.keep) {
            if (const auto kept = script.keep(i, picture.image); !kept) {
                return kept.error();
            }
        }
        progress(share + (1 - share) * (i + 1) / script.pictures);
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
