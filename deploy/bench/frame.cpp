// bench frame: one process draws frames along the path, or along each axis.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "deploy/bench/cases.h"
#include "deploy/bench/in_process.h"
#include "deploy/bench/options.h"
#include "deploy/bench/report.h"
#include "deploy/bench/subcommands.h"
#include "deploy/progress_bar.h"

namespace shearwater::bench {
namespace {

struct FrameFlags {
    Options common;
    CaseOptions drawn{.workloads = {"W1"}};
    bool parallel = false;
    bool axes = false;
};

Record row(const FrameFlags& flags, const Case& drawn, const InProcess& cube, const std::string& view,
           const std::vector<FrameTimes>& frames) {
    const FrameSummary all = summary(frames);
    Record record;
    record.text("workload", drawn.name)
        .text("cube", cube_text(cube.lattice().n), 12)
        .text("view", view, 11)
        .count("threads", static_cast<std::uint64_t>(cube.threads()))
        .aside("copies", flags.drawn.cube.copies)
        .aside("image", flags.common.image)
        .aside("quality", flags.common.quality)
        .aside("classify", flags.common.drawing.classify)
        .aside("lod", flags.common.drawing.lod)
        .count("level", static_cast<std::uint64_t>(frames.front().level))
        .aside("frames", static_cast<double>(frames.size()))
        .number("median_s", all.total.median, 5)
        .number("min_s", all.total.least, 5)
        .number("max_s", all.total.most, 5)
        .aside("samples", all.samples)
        .number("Msamples", all.samples / 1e6, 2)
        .number("Gsamples_per_s", all.samples_per_second / 1e9, 3)
        .number("factorise_s", all.factorise, 5)
        .number("render_s", all.render, 5)
        .number("warp_s", all.warp, 5)
        .number("encode_s", all.encode, 5);
    return record;
}

// The path's first view with the cube's axes changed in a ring `steps` times, so that it is the same
// view along each of them.
view::Camera along_axis(view::Camera camera, int steps) {
    for (int i = 0; i < steps; ++i) {
        camera.eye = {camera.eye.z, camera.eye.x, camera.eye.y};
        camera.up = {camera.up.z, camera.up.x, camera.up.y};
    }
    return camera;
}

base::Status draw_axes(const FrameFlags& flags, const Case& drawn, InProcess& cube,
                       const deploy::ViewOptions& view, Report& report) {
    const auto camera = view.camera(cube.lattice());
    if (!camera) {
        return camera.error();
    }
    const view::ImageSize size = *view.image_size();
    constexpr std::array<const char*, 3> names{"along z", "along x", "along y"};
    std::array<std::vector<FrameTimes>, 3> frames;
    deploy::ProgressBar bar(drawn.name);
    // By turns, so that a slow phase of the machine falls on all of them.
    for (int i = -1; i < flags.common.frames; ++i) {
        for (int steps = 0; steps < 3; ++steps) {
            const FrameTimes times = cube.draw(along_axis(*camera, steps), size, view.sampling(), drawn.tf);
            if (i >= 0) {
                frames.at(static_cast<std::size_t>(steps)).push_back(times);
            }
        }
        bar.show(static_cast<double>(i + 2) / (flags.common.frames + 1));
    }
    for (const std::size_t axis : {1U, 2U, 0U}) {
        report.add(row(flags, drawn, cube, names.at(axis), frames.at(axis)));
    }
    return {};
}

base::Status draw(const FrameFlags& flags, const Case& drawn, Report& report) {
    auto cube = load(drawn, flags.common.threads);
    if (!cube) {
        return cube.error();
    }
    auto view = flags.common.view(std::ranges::max(cube->lattice().n));
    if (!view) {
        return view.error();
    }
    view->parallel = flags.parallel;
    if (flags.axes) {
        return draw_axes(flags, drawn, *cube, *view, report);
    }
    deploy::ProgressBar bar(drawn.name);
    const auto frames =
        cube->draw_path(*view, flags.common.frames, drawn.tf, [&](double share) { bar.show(share); });
    if (!frames) {
        return frames.error();
    }
    report.add(row(flags, drawn, *cube, flags.parallel ? "parallel" : "perspective", *frames));
    return {};
}

base::Status frame(const FrameFlags& flags) {
    if (auto valid = flags.drawn.cube.validate(); !valid) {
        return valid;
    }
    if (const auto view = flags.common.view(flags.drawn.edge); !view) {
        return view.error();
    }
    const auto cases = flags.drawn.cases();
    if (!cases) {
        return cases.error();
    }
    auto report = Report::open("frame", flags.common.json);
    if (!report) {
        return report.error();
    }
    for (const Case& drawn : *cases) {
        if (auto done = draw(flags, drawn, *report); !done) {
            return done;
        }
    }
    return report->close();
}

}  // namespace

Run add_frame(CLI::App& app) {
    auto flags = std::make_shared<FrameFlags>();
    flags->drawn.add_to(app);
    app.add_flag("--parallel", flags->parallel, "parallel projection");
    app.add_flag("--axes", flags->axes, "the first view alone, along each of the cube's axes");
    flags->common.add_pictures(app);
    return [flags] { return status_of("frame", frame(*flags)); };
}

}  // namespace shearwater::bench
