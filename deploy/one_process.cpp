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

class Stopwatch {
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

std::vector<view::Camera> eyes_of(const view::Camera& camera, const options::StereoOptions& stereo) {
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

// A cube's voxels by one mapping at a time, and what is known of them.
class Loaded {
  public:
    Loaded(cube::Cube& source, const view::Lattice& lattice, int copies, culling::Kind culling,
           base::Workers& workers)
        : source_(source), lattice_(lattice), copies_(copies), culling_(culling), workers_(workers) {}

    // Reads them, unless it has them so already.
    base::Status hold(const volume::Mapping& mapping, const volume::Progress& progress) {
        if (volume_ && mapping_ == mapping) {
            return {};
        }
        culler_.reset();
        volume_.reset();
        auto read = shear::BrickVolume::load(*source_.source, volume::whole(lattice_.n), lattice_.n, mapping,
                                             workers_, progress);
        if (!read) {
            return read.error();
        }
        if (const auto kept = read->keep_copies(copies_, workers_); !kept) {
            return kept;
        }
        volume_.emplace(*std::move(read));
        mapping_ = mapping;
        classifier_ = {};
        if (culling_ != culling::Kind::off) {
            culler_.emplace(*volume_, lattice_.spacing);
        }
        return {};
    }
    const shear::BrickVolume& volume() const { return *volume_; }
    shear::Classifier& classifier() { return classifier_; }
    culling::Culler* culler() { return culler_ ? &*culler_ : nullptr; }

  private:
    cube::Cube& source_;
    const view::Lattice lattice_;
    const int copies_;
    const culling::Kind culling_;
    base::Workers& workers_;
    std::optional<shear::BrickVolume> volume_;
    volume::Mapping mapping_;
    shear::Classifier classifier_;
    std::optional<culling::Culler> culler_;
};

base::Result<Picture> draw_in_process(const options::CubeOptions& cube, const ViewOptions& view,
                                      const Script& script, int threads, const volume::Progress& progress) {
    base::Workers workers(threads);
    Stopwatch stopwatch;
    auto opened = cube::open(cube.path, cube.open_options());
    if (!opened) {
        return opened.error();
    }
    for (const std::string& note : opened->info.notes) {
        std::fprintf(stderr, "note: %s\n", note.c_str());
    }
    const view::Lattice lattice{.n = opened->info.n, .spacing = cube.spacing_value()};
    const auto size = view.image_size();
    const auto crop = view.crop.box_of(lattice);
    if (!size || !crop) {
        return size ? crop.error() : size.error();
    }
    double load = stopwatch.lap();
    const double share = script.pictures > 1 ? 0.5 : 1;  // of the progress, for loading
    const auto loading = [&](double fraction) { progress(share * fraction); };
    const auto values = values_of(*opened, cube, script.unit, workers, loading);
    if (!values) {
        return values.error();
    }
    const KnownCube known{lattice, view::ValueScale(values->mapping, values->summary)};
    auto shot = script.shot(0, known);
    if (!shot) {
        return shot.error();
    }
    double preprocess = stopwatch.lap();
    const auto second_half = [&](double fraction) { loading(0.5 + fraction / 2); };
    const culling::Settings culling = view.drawing.culling_settings();
    view::Sampling sampling = view.sampling();
    sampling.opaque = culling.opaque();
    Loaded loaded(*opened, lattice, cube.copies, culling.kind, workers);
    const auto hold = [&](const volume::Progress& told) {
        return loaded.hold(shot->scaling ? volume::Mapping::of(*shot->scaling, cube.bits) : values->mapping,
                           told);
    };
    if (const auto held = hold(second_half); !held) {
        return held.error();
    }
    load += stopwatch.lap();

    Picture picture;
    std::vector<Seconds> times;
    for (int i = 0; i < script.pictures; ++i) {
        if (i > 0) {
            shot = script.shot(i, known);
            if (!shot) {
                return shot.error();
            }
            if (const auto held = hold({}); !held) {
                return held.error();
            }
        }
        culling::Culler* const culler = loaded.culler();
        const view::TransferFunction& tf = shot->tf;
        stopwatch.lap();
        const std::vector<view::Camera> eyes = eyes_of(shot->camera, view.stereo);
        const auto factorisations = view::factorise(eyes, *size, lattice, sampling, *crop);
        if (culler) {
            culler->prepare(tf, culling.kind, factorisations.front().level(), workers);
            preprocess += stopwatch.lap();
        }
        const auto& classification =
            loaded.classifier().classify(loaded.volume(), tf, factorisations.front().classify, workers);
        Seconds spent{.load = load, .preprocess = preprocess};
        shear::RenderStats stats;
        std::vector<image::Image<image::Rgba8>> pictures;
        for (std::size_t eye = 0; eye < eyes.size(); ++eye) {
            const auto& factorisation = factorisations[eye];
            const auto visible =
                culler ? std::optional(culler->visible(factorisation, tf, culling, workers)) : std::nullopt;
            spent.look += stopwatch.lap();
            const auto [windows, of_eye] = shear::render(loaded.volume(), classification, factorisation,
                                                         workers, {.visible = visible ? &*visible : nullptr});
            add(of_eye, stats);
            spent.render += stopwatch.lap();
            pictures.push_back(image::warp(factorisation, windows, eyes[eye], *size, tf.background, workers));
            spent.warp += stopwatch.lap();
        }
        const auto mode = view.stereo.mode();
        picture.image =
            mode ? image::composed(pictures.front(), pictures.back(), *mode) : std::move(pictures.front());
        spent.total = spent.look + spent.render + spent.warp;
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
        picture.culling_by = culler ? "process" : "nobody";
    }
    picture.seconds = median(times);
    picture.each = std::move(times);
    picture.tree = "1,1";
    picture.memory.push_back({"shearwater", base::memory_use().peak});
    return picture;
}

}  // namespace shearwater::deploy
