#include "deploy/bench/in_process.h"

#include <optional>

#include "common/cube/open.h"
#include "common/image/rle.h"
#include "common/image/warp.h"
#include "common/volume/statistics.h"
#include "deploy/bench/machine.h"
#include "deploy/bench/workload.h"
#include "renderer/shear/render.h"

namespace shearwater::bench {

namespace {

double median_of(const std::vector<FrameTimes>& frames, double FrameTimes::*stage) {
    std::vector<double> values;
    for (const FrameTimes& frame : frames) {
        values.push_back(frame.*stage);
    }
    return spread(std::move(values)).median;
}

base::Result<volume::Mapping> mapping_for(cube::Cube& cube, const options::CubeOptions& options,
                                          base::Workers& workers) {
    volume::Mapping mapping{.stretch = options.stretch_value(), .bits = options.bits};
    if (options.range.size() == 2) {
        mapping.lo = options.range[0];
        mapping.hi = options.range[1];
        return mapping;
    }
    const auto& n = cube.info.n;
    const auto histogram = volume::count_values(*cube.source, volume::whole(n), n, workers);
    if (!histogram) {
        return histogram.error();
    }
    const volume::Limits limits = volume::percentile_limits(*histogram, options.percentile);
    mapping.lo = limits.lo;
    mapping.hi = limits.hi;
    return mapping;
}

}  // namespace

FrameSummary summary(const std::vector<FrameTimes>& frames) {
    FrameSummary all;
    std::vector<double> totals;
    double seconds = 0;
    for (const FrameTimes& frame : frames) {
        totals.push_back(frame.total());
        all.samples += static_cast<double>(frame.samples);
        seconds += frame.render;
    }
    all.samples_per_second = seconds > 0 ? all.samples / seconds : 0;
    all.samples /= static_cast<double>(frames.size());
    all.total = spread(std::move(totals));
    all.factorise = median_of(frames, &FrameTimes::factorise);
    all.cull = median_of(frames, &FrameTimes::cull);
    all.render = median_of(frames, &FrameTimes::render);
    all.warp = median_of(frames, &FrameTimes::warp);
    all.encode = median_of(frames, &FrameTimes::encode);
    return all;
}

base::Result<InProcess> InProcess::load(const options::CubeOptions& options, int threads,
                                        const volume::Progress& progress) {
    auto cube = cube::open(options.path, options.open_options());
    if (!cube) {
        return cube.error();
    }
    const auto voxels = static_cast<std::uint64_t>(volume::voxel_count(cube->info.n));
    if (const auto fits = check_memory(
            "load " + options.path, voxels * static_cast<std::uint64_t>(options.bits / 8 * options.copies));
        !fits) {
        return fits.error();
    }
    auto workers = std::make_unique<base::Workers>(threads);
    const auto mapping = mapping_for(*cube, options, *workers);
    if (!mapping) {
        return mapping.error();
    }
    const view::Lattice lattice{.n = cube->info.n, .spacing = options.spacing_value()};
    auto bricks = shear::BrickVolume::load(*cube->source, volume::whole(lattice.n), lattice.n, *mapping,
                                           *workers, progress);
    if (!bricks) {
        return bricks.error();
    }
    if (const auto kept = bricks->keep_copies(options.copies, *workers); !kept) {
        return kept.error();
    }
    return InProcess(lattice, std::move(workers), *std::move(bricks));
}

FrameTimes InProcess::draw(const view::Camera& camera, const view::ImageSize& size, view::Sampling sampling,
                           const view::TransferFunction& tf, const Culling* culling) {
    FrameTimes times;
    Clock clock;
    if (culling != nullptr) {
        sampling.opaque = culling->settings.opaque();
    }
    const auto factorisation = view::factorise(camera, size, lattice_, sampling);
    times.factorise = clock.lap();
    std::optional<culling::VisibleBlocks> visible;
    if (culling != nullptr) {
        culling->culler.prepare(tf, culling->settings.kind, factorisation.level(), *workers_);
        clock.lap();
        visible = culling->culler.visible(factorisation, tf, culling->settings, *workers_);
        times.cull = clock.lap();
    }
    const auto& classification = classifier_.classify(bricks_, tf, factorisation.classify, *workers_);
    const auto [windows, stats] = shear::render(bricks_, classification, factorisation, *workers_,
                                                {.visible = visible ? &*visible : nullptr});
    times.render = clock.lap();
    const auto picture = image::warp(factorisation, windows, camera, size, tf.background, *workers_);
    times.warp = clock.lap();
    const base::Buffer coded = image::encode_rle(picture.pixels(), *workers_);
    times.encode = clock.lap();
    times.samples = stats.samples;
    times.level = factorisation.level();
    return times;
}

base::Result<std::vector<FrameTimes>> InProcess::draw_path(deploy::ViewOptions view, int frames,
                                                           const view::TransferFunction& tf,
                                                           const volume::Progress& progress) {
    const auto size = view.image_size();
    if (!size) {
        return size.error();
    }
    std::vector<FrameTimes> times;
    view.orbit.azimuth -= Path::turn;
    for (int i = -1; i < frames; ++i) {
        const auto camera = view.camera(lattice_);
        if (!camera) {
            return camera.error();
        }
        const FrameTimes frame = draw(*camera, *size, view.sampling(), tf);
        if (i >= 0) {
            times.push_back(frame);
        }
        view.orbit.azimuth += Path::turn;
        progress(static_cast<double>(i + 2) / static_cast<double>(frames + 1));
    }
    return times;
}

}  // namespace shearwater::bench
