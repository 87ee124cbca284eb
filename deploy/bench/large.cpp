// bench large: the paper's largest run. Renderers make their own part of the cube, which no file holds.

#include <CLI/CLI.hpp>
#include <algorithm>

#include "deploy/bench/paper.h"
#include "deploy/bench/path_on_tree.h"
#include "deploy/bench/report.h"
#include "deploy/bench/subcommands.h"
#include "deploy/bench/timing.h"

namespace shearwater::bench {
namespace {

Record row(const PathOnTree& flags, const PathOnTree::Drawn& drawn) {
    const deploy::Picture& picture = drawn.picture;
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
        .aside("nodes", drawn.nodes)
        .aside("frames", flags.common.frames)
        .count("renderers", static_cast<std::uint64_t>(drawn.renderers))
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

base::Status large(const PathOnTree& flags) {
    auto report = Report::open("large", flags.common.json);
    if (!report) {
        return report.error();
    }
    const auto drawn = flags.draw();
    if (!drawn) {
        return drawn.error();
    }
    report->add(row(flags, *drawn));
    return report->close();
}

}  // namespace

Run add_large(CLI::App& app) {
    auto flags = std::make_shared<PathOnTree>(PathOnTree{.common = {}, .tree = {32, 2}, .edge = 2048});
    flags->common.frames = 3;
    app.add_option("--synthetic", flags->edge, "the cube's voxels along each axis")
        ->check(CLI::Range(std::int64_t{2}, std::int64_t{1} << 20U))
        ->capture_default_str();
    flags->add_to(app);
    return [flags] { return status_of("large", large(*flags)); };
}

}  // namespace shearwater::bench
