// bench trees: the paper's Table 1, with real daemons.

#include <CLI/CLI.hpp>
#include <bit>
#include <optional>

#include "deploy/bench/in_process.h"
#include "deploy/bench/on_tree.h"
#include "deploy/bench/options.h"
#include "deploy/bench/paper.h"
#include "deploy/bench/report.h"
#include "deploy/bench/subcommands.h"
#include "deploy/bench/workload.h"
#include "deploy/progress_bar.h"

namespace shearwater::bench {
namespace {

struct TreesFlags {
    Options common;
    std::vector<std::int64_t> edges{64, 128, 256, 512, 1024};
    std::vector<int> nodes{1, 3, 7, 15, 31};
    std::string workload = "W1";
    int copies = 1;
};

// What a row says of the frames, by whatever they were drawn.
struct Drawn {
    Spread total;
    double pace = 0;  // seconds from picture to picture, where several are under way
    double render = 0, composite = 0, warp = 0, encode = 0;
    int renderers = 1;
};

std::string title(const TreesFlags& flags, std::int64_t edge, int nodes) {
    return flags.workload + " " + std::to_string(edge) + "^3, " +
           (nodes == 1 ? "one process" : std::to_string(nodes) + " nodes");
}

options::CubeOptions cube_of(const TreesFlags& flags, std::int64_t edge) {
    options::CubeOptions cube = workload(flags.workload).cube(edge);
    cube.copies = flags.copies;
    return cube;
}

base::Result<Drawn> draw_here(const TreesFlags& flags, std::int64_t edge) {
    const Workload work = workload(flags.workload);
    deploy::ProgressBar bar(title(flags, edge, 1));
    const auto show = [&](double share) { bar.show(share); };
    auto cube = InProcess::load(cube_of(flags, edge), flags.common.threads, show);
    if (!cube) {
        return cube.error();
    }
    const auto frames = cube->draw_path(*flags.common.view(edge), flags.common.frames, work.tf, show);
    if (!frames) {
        return frames.error();
    }
    const FrameSummary all = summary(*frames);
    return Drawn{.total = all.total,
                 .pace = all.total.median,
                 .render = all.render,
                 .composite = 0,
                 .warp = all.warp,
                 .encode = all.encode};
}

base::Result<Drawn> draw_by_tree(const TreesFlags& flags, std::int64_t edge, int nodes) {
    const Workload work = workload(flags.workload);
    const int levels = std::countr_one(static_cast<unsigned>(nodes));
    auto tree = OnTree::start(cube_of(flags, edge), 2, levels, flags.common.threads);
    if (!tree) {
        return tree.error();
    }
    deploy::ProgressBar bar(title(flags, edge, nodes));
    const auto picture = tree->draw_path(
        *flags.common.view(edge), flags.common.frames, work.tf, [&](double share) { bar.show(share); },
        flags.common.in_flight);
    if (!picture) {
        return picture.error();
    }
    std::vector<double> totals;
    double all = 0;
    for (const deploy::Seconds& seconds : picture->each) {
        totals.push_back(seconds.total);
        all += seconds.interval;
    }
    const Spread total = spread(std::move(totals));
    const deploy::Seconds& seconds = picture->seconds;
    return Drawn{.total = total,
                 .pace = flags.common.in_flight > 1 ? all / flags.common.frames : total.median,
                 .render = seconds.render,
                 .composite = seconds.composite,
                 .warp = seconds.warp,
                 .encode = seconds.encode,
                 .renderers = tree->renderers()};
}

Record row(const TreesFlags& flags, std::int64_t edge, int nodes, const Drawn& drawn,
           std::optional<double> three_nodes) {
    const double seconds = drawn.total.median;
    const auto paper = paper::tree_seconds(edge, nodes);
    // Speed a node, of that with three nodes, as the paper has it.
    std::optional<double> efficiency;
    if (three_nodes && nodes > 1) {
        efficiency = *three_nodes * 3 / (seconds * nodes);
    }
    Record record;
    record.text("cube", std::to_string(edge) + "^3")
        .aside("workload", flags.workload)
        .aside("copies", flags.copies)
        .aside("image", flags.common.image)
        .aside("frames", flags.common.frames)
        .count("nodes", static_cast<std::uint64_t>(nodes))
        .count("renderers", static_cast<std::uint64_t>(drawn.renderers))
        .number("median_s", seconds, 4)
        .number("min_s", drawn.total.least, 4)
        .number("max_s", drawn.total.most, 4)
        .aside("in_flight", nodes == 1 ? 1 : flags.common.in_flight)
        .number("frames_per_s", 1 / drawn.pace, 2)
        .number("efficiency", efficiency, 2)
        .number("paper_s", paper, 2)
        .number("paper_frames_per_s", paper ? std::optional(1 / *paper) : std::nullopt, 2)
        .number("times_faster", paper ? std::optional(*paper / seconds) : std::nullopt, 1)
        .aside("render_s", drawn.render)
        .aside("composite_s", drawn.composite)
        .aside("warp_s", drawn.warp)
        .aside("encode_s", drawn.encode);
    return record;
}

base::Status trees(const TreesFlags& flags) {
    for (const std::int64_t edge : flags.edges) {
        if (const auto view = flags.common.view(edge); !view) {
            return view.error();
        }
    }
    auto report = Report::open("trees", flags.common.json);
    if (!report) {
        return report.error();
    }
    for (const std::int64_t edge : flags.edges) {
        std::optional<double> three_nodes;
        for (const int nodes : flags.nodes) {
            const auto drawn = nodes == 1 ? draw_here(flags, edge) : draw_by_tree(flags, edge, nodes);
            if (!drawn) {
                return drawn.error();
            }
            if (nodes == 3) {
                three_nodes = drawn->total.median;
            }
            report->add(row(flags, edge, nodes, *drawn, three_nodes));
        }
    }
    report->note(
        "1 node is one process without links. The paper's nodes were machines; all of these are here.");
    return report->close();
}

std::string check_nodes(const std::string& text) {
    const CLI::Range range(1, 127);
    const std::string wrong = range(text);
    return wrong.empty() && std::has_single_bit(static_cast<unsigned>(std::stoi(text)) + 1)
               ? ""
               : text + " is not the size of a full binary tree: 1, 3, 7, 15, 31, 63 or 127";
}

}  // namespace

Run add_trees(CLI::App& app) {
    auto flags = std::make_shared<TreesFlags>();
    add_sizes(app, flags->edges);
    app.add_option("--nodes", flags->nodes, "of binary trees, with commas between; 1: in one process")
        ->delimiter(',')
        ->check(CLI::Validator(check_nodes, "NODES", "nodes"))
        ->capture_default_str();
    add_workload(app, flags->workload);
    options::add_copies(app, flags->copies);
    flags->common.add_in_flight(app);
    flags->common.add_pictures(app);
    return [flags] { return status_of("trees", trees(*flags)); };
}

}  // namespace shearwater::bench
