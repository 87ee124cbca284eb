// bench large: the paper's largest run. Renderers make their own part of the cube, which no file holds.

#include <CLI/CLI.hpp>
#include <algorithm>

#include "deploy/bench/on_tree.h"
#include "deploy/bench/options.h"
#include "deploy/bench/paper.h"
#include "deploy/bench/report.h"
#include "deploy/bench/subcommands.h"
#include "deploy/bench/timing.h"
#include "deploy/bench/workload.h"
#include "deploy/progress_bar.h"

namespace shearwater::bench {
namespace {

struct LargeFlags {
    Options common;
    std::vector<int> tree{32, 2};
    std::int64_t edge = 2048;
    std::string workload = "W1";
};

Record row(const LargeFlags& flags, const OnTree& tree, const deploy::Picture& picture) {
    std::vector<double> totals;
    std::vector<double> renders;
    for (const deploy::Seconds& seconds : picture.each) {
        totals.push_back(seconds.total);
        renders.push_back(seconds.render);
    }
    std::uint64_t peak = 0, peaks = 0;
    for (const deploy::ProcessMemory& process : picture.memory) {
        peak = std::max(peak, process.peak_bytes);
        peaks += process.peak_bytes;
    }
    const Spread total = spread(std::move(totals));
    const bool papers = flags.edge == 2048 && flags.workload == "W1";
    const auto paper = [&](double value) { return papers ? std::optional(value) : std::nullopt; };
    Record record;
    record.text("workload", flags.workload)
        .text("cube", std::to_string(flags.edge) + "^3")
        .text("tree", picture.tree)
        .aside("image", flags.common.image)
        .aside("nodes", tree.nodes())
        .aside("frames", flags.common.frames)
        .count("renderers", static_cast<std::uint64_t>(tree.renderers()))
        .number("load_s", picture.seconds.load, 1)
        .number("median_s", total.median, 3)
        .number("min_s", total.least, 3)
        .number("max_s", total.most, 3)
        .aside("samples", static_cast<double>(picture.samples))
        .number("Gsamples_per_s", static_cast<double>(picture.samples) / total.median / 1e9, 3)
        .number("MiB_each", static_cast<double>(peak) / (1U << 20U), 0)
        .number("MiB_in_all", static_cast<double>(peaks) / (1U << 20U), 0)
        .number("paper_s", paper(paper::large_seconds), 0)
        .number("paper_MiB_each", paper(paper::large_mib_each), 0)
        .number("times_faster", paper(paper::large_seconds / total.median), 1);
    return record;
}

base::Status large(const LargeFlags& flags) {
    const auto view = flags.common.view(flags.edge);
    if (!view) {
        return view.error();
    }
    auto report = Report::open("large", flags.common.json);
    if (!report) {
        return report.error();
    }
    const Workload work = workload(flags.workload);
    auto tree = OnTree::start(work.cube(flags.edge), flags.tree[0], flags.tree[1], flags.common.threads);
    if (!tree) {
        return tree.error();
    }
    const auto picture = [&] {
        deploy::ProgressBar bar("making " + std::to_string(flags.edge) + "^3 voxels");
        return tree->draw_path(*view, flags.common.frames, work.tf, [&](double share) { bar.show(share); });
    }();
    if (!picture) {
        return picture.error();
    }
    report->add(row(flags, *tree, *picture));
    return report->close();
}

}  // namespace

Run add_large(CLI::App& app) {
    auto flags = std::make_shared<LargeFlags>();
    flags->common.frames = 3;
    app.add_option("--synthetic", flags->edge, "the cube's voxels along each axis")
        ->check(CLI::Range(std::int64_t{2}, std::int64_t{1} << 20U))
        ->capture_default_str();
    app.add_option("--tree", flags->tree, "branching and levels")
        ->delimiter(',')
        ->expected(2)
        ->allow_extra_args(false)
        ->type_name("B,LEVELS")
        ->default_str("32,2");
    add_workload(app, flags->workload);
    flags->common.add_frames(app);
    flags->common.add_image(app);
    flags->common.add_quality(app);
    flags->common.drawing.add_classify(app);
    flags->common.drawing.add_lod(app);
    flags->common.add_threads(app);
    flags->common.add_json(app);
    return [flags] { return status_of("large", large(*flags)); };
}

}  // namespace shearwater::bench
