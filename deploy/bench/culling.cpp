// bench culling: what leaving out hidden blocks saves, and what it takes.

#include "deploy/bench/culling.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "common/base/check.h"
#include "deploy/bench/options.h"
#include "deploy/bench/subcommands.h"
#include "deploy/bench/workload.h"

namespace shearwater::bench {

view::Camera CullingRun::camera(double degrees) const {
    deploy::ViewOptions turned = view;
    turned.orbit.azimuth += degrees;
    const auto camera = turned.camera(cube.lattice());
    base::check(camera.has_value(), "the first view's camera was checked");
    return *camera;
}

view::Factorisation CullingRun::factorisation(double degrees) const {
    return view::factorise(camera(degrees), size(), cube.lattice(), view.sampling());
}

std::string CullingRun::title() const {
    return drawn.name + ", " + cube_text(cube.lattice().n) + ", " +
           (view.parallel ? "parallel" : "perspective");
}

Record CullingRun::record() const {
    Record record;
    record.aside("workload", drawn.name)
        .aside("cube", cube_text(cube.lattice().n))
        .aside("view", view.parallel ? "parallel" : "perspective")
        .aside("image", view.size)
        .aside("threshold", threshold)
        .aside("block", static_cast<double>(block))
        .aside("threads", cube.threads());
    return record;
}

culling::BlockSet opaque_blocks(const shear::BrickVolume& volume, const shear::Classification& classification,
                                const culling::BlockGrid& grid) {
    culling::BlockSet opaque(grid.size());
    const shear::CodeGrid& micro = volume.level(0).micro_bricks();
    volume::Index3 at;
    for (at[2] = 0; at[2] < micro.counts()[2]; ++at[2]) {
        for (at[1] = 0; at[1] < micro.counts()[1]; ++at[1]) {
            for (at[0] = 0; at[0] < micro.counts()[0]; ++at[0]) {
                if (classification.micro_bricks[0][micro.index(at)].opaque_octants != 0) {
                    const std::int64_t in_block = grid.edge() / micro.edge();
                    opaque.bytes()[grid.index({at[0] / in_block, at[1] / in_block, at[2] / in_block})] = 1;
                }
            }
        }
    }
    return opaque;
}

std::uint64_t count_of_both(const culling::BlockSet& a, const culling::BlockSet& b) {
    std::uint64_t both = 0;
    for (std::size_t block = 0; block < a.size(); ++block) {
        both += a.contains(block) && b.contains(block) ? 1 : 0;
    }
    return both;
}

namespace {

const std::vector<std::string>& table_names() {
    static const std::vector<std::string> names{"views", "functions", "frames", "family",
                                                "pass",  "pass-many", "shared", "drag"};
    return names;
}

struct CullingFlags {
    Options common;
    CaseOptions drawn{.workloads = {"W3"}};
    std::vector<std::string> tables{"views", "functions", "frames", "family", "pass"};
    std::int64_t block = culling::BlockGrid::default_edge;
    bool parallel = false;
    int check = 0;

    bool shows(const std::string& table) const { return std::ranges::find(tables, table) != tables.end(); }
};

// Whether no picture differed that was checked.
base::Result<bool> measure(const CullingFlags& flags, const Case& drawn, Report& report) {
    auto cube = load(drawn, flags.common.threads);
    if (!cube) {
        return cube.error();
    }
    auto view = flags.common.view(std::ranges::max(cube->lattice().n));
    if (!view) {
        return view.error();
    }
    view->parallel = flags.parallel;
    if (const auto camera = view->camera(cube->lattice()); !camera) {
        return camera.error();
    }
    const CullingRun run{.drawn = drawn,
                         .cube = *cube,
                         .view = *view,
                         .threshold = flags.common.drawing.culling_threshold,
                         .block = flags.block,
                         .frames = flags.common.frames,
                         .report = report};
    if (flags.check > 0) {
        return culling_check(run, flags.check);
    }
    using Table = void (*)(const CullingRun&);
    const std::vector<std::pair<std::string, Table>> tables{{"views", culling_views},
                                                            {"functions", culling_functions},
                                                            {"frames", culling_frames},
                                                            {"family", culling_family},
                                                            {"pass", culling_pass}};
    for (const auto& [name, show] : tables) {
        if (flags.shows(name)) {
            show(run);
        }
    }
    return true;
}

base::Result<bool> culling(const CullingFlags& flags) {
    if (auto valid = flags.drawn.cube.validate(); !valid) {
        return valid.error();
    }
    const auto view = flags.common.view(flags.drawn.edge);
    if (!view) {
        return view.error();
    }
    const auto cases = flags.drawn.cases();
    if (!cases) {
        return cases.error();
    }
    auto report = Report::open("culling", flags.common.json);
    if (!report) {
        return report.error();
    }
    bool same = true;
    const bool of_cubes = flags.check > 0 || std::ranges::any_of(flags.tables, [](const std::string& table) {
                              return table != "pass-many" && table != "shared" && table != "drag";
                          });
    for (const Case& drawn : *cases) {
        if (of_cubes) {
            const auto done = measure(flags, drawn, *report);
            if (!done) {
                return done.error();
            }
            same = same && *done;
        }
        if (flags.check == 0 && flags.shows("drag")) {
            const auto done = culling_drag(drawn, *view, flags.common.drawing.culling_threshold,
                                           flags.common.frames, flags.common.threads, *report);
            if (!done) {
                return done.error();
            }
        }
    }
    if (flags.check == 0 && flags.shows("pass-many")) {
        base::Workers workers(flags.common.threads);
        const auto done = culling_pass_of_many(*view, flags.common.drawing.culling_threshold,
                                               flags.common.frames, workers, *report);
        if (!done) {
            return done.error();
        }
    }
    if (flags.check == 0 && flags.shows("shared")) {
        const auto done =
            culling_shared(*view, flags.common.drawing.culling_threshold, flags.common.frames, *report);
        if (!done) {
            return done.error();
        }
    }
    if (auto closed = report->close(); !closed) {
        return closed.error();
    }
    return same;
}

}  // namespace

Run add_culling(CLI::App& app) {
    auto flags = std::make_shared<CullingFlags>();
    flags->common.drawing.lod = "off";
    flags->drawn.add_to(app);
    app.add_option("--tables", flags->tables,
                   "what is measured, with commas between; pass-many, shared: a cube of 2048^3 voxels; drag: "
                   "by a tree")
        ->delimiter(',')
        ->check(CLI::IsMember(table_names()))
        ->capture_default_str();
    app.add_option("--check", flags->check,
                   "instead, so many pictures at random with culling and without; ends with 1 if one differs")
        ->check(CLI::Range(1, 1000000));
    flags->common.drawing.add_culling_threshold(app);
    app.add_option("--block", flags->block, "voxels along a block's side, 16 or 32")
        ->check(CLI::IsMember({16, 32}))
        ->capture_default_str();
    app.add_flag("--parallel", flags->parallel, "parallel projection");
    flags->common.add_frames(app);
    flags->common.add_image(app);
    flags->common.add_quality(app);
    flags->common.drawing.add_classify(app);
    flags->common.add_threads(app);
    flags->common.add_json(app);
    return [flags] {
        const auto same = culling(*flags);
        if (!same) {
            return status_of("culling", same.error());
        }
        return *same ? 0 : 1;
    };
}

}  // namespace shearwater::bench
