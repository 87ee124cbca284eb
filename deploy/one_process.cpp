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

struct Values {
    volume::Mapping mapping;
    std::shared_ptr<const volume::Summary> summary;  // where they are counted
};

// Counts them where the limits come from that, or what is drawn does.
base::Result<Values> values_of(cube::Cube& opened, const options::CubeOptions& cube, view::Unit unit,
                               base::Workers& workers, const volume::Progress& progress) {
    volume::Mapping mapping{.stretch = cube.stretch_value(), .bits = cube.bits};
    const bool has_range = cube.range.size() == 2;
    if (has_range) {
        mapping.lo = cube.range[0];
        mapping.hi = cube.range[1];
    }
    if (has_range && (unit == view::Unit::stretched || unit == view::Unit::value)) {
        return Values{mapping, nullptr};
    }
    const auto& n = opened.info.n;
    const auto half = [&](double fraction) { progress(fraction / 2); };
    const auto histogram = volume::count_values(*opened.source, volume::whole(n), n, workers, half);
    if (!histogram) {
        return histogram.error();
    }
    if (!has_range) {
        const volume::Limits limits = volume::percentile_limits(*histogram, cube.percentile);
        mapping.lo = limits.lo;
        mapping.hi = limits.hi;
    }
    return Values{mapping, std::make_shared<const volume::Summary>(volume::summarise(*histogram, mapping))};
}

}  // namespace

base::Result<Picture> draw_in_process(const options::CubeOptions& cube, const ViewOptions& view,
                                      const view::AnchoredFunction& function, int threads, int repeat,
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
    if (!size || !camera) {
        return size ? camera.error() : size.error();
    }
    double load = clock.lap();
    const auto values = values_of(*opened, cube, function.unit, workers, progress);
    if (!values) {
        return values.error();
    }
    const view::ValueScale scale(values->mapping, values->summary);
    const auto put = view::on_scale(function, &scale);
    if (!put) {
        return put.error();
    }
    const view::TransferFunction& tf = *put;
    double preprocess = clock.lap();
    const auto second_half = [&](double fraction) { progress(0.5 + fraction / 2); };
    const auto volume = shear::BrickVolume::load(*opened->source, volume::whole(lattice.n), lattice.n,
                                                 values->mapping, workers, second_half);
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
        const auto level = view::factorise(*camera, *size, lattice, view.sampling()).level();
        culler.emplace(*volume, lattice.spacing);
        culler->prepare(tf, culling.kind, level, workers);
        preprocess += clock.lap();
    }
    for (int i = 0; i < repeat; ++i) {
        clock.lap();
        const auto factorisation = view::factorise(*camera, *size, lattice, view.sampling());
        shear::RenderStats stats;
        const auto& classification = classifier.classify(*volume, tf, factorisation.classify, workers);
        const auto visible =
            culler ? std::optional(culler->visible(factorisation, tf, culling, workers)) : std::nullopt;
        const auto windows = shear::render(*volume, classification, factorisation, workers, &stats, {},
                                           visible ? &*visible : nullptr);
        const double render = clock.lap();
        picture.image = image::warp(factorisation, windows, *camera, *size, tf.background, workers);
        const double warp = clock.lap();
        times.push_back({.load = load,
                         .preprocess = preprocess,
                         .render = render,
                         .composite = 0,
                         .warp = warp,
                         .encode = 0,
                         .total = render + warp});
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
