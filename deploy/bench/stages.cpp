// bench stages: the paper's Figure 8, where the time of one frame goes.

#include "deploy/bench/on_tree.h"

#include <CLI/CLI.hpp>
#include "deploy/bench/options.h"
#include "deploy/bench/report.h"
#include "deploy/bench/subcommands.h"
#include "deploy/bench/timing.h"
#include "deploy/bench/workload.h"
#include "deploy/progress_bar.h"

namespace shearwater::bench {
namespace {

struct StagesFlags {
    Options common;
    std::vector<int> tree{2, 3};
    std::int64_t edge = 256;
    std::string workload = "W1";
};

struct Stage {
    const char* name;
    double seconds;
    const char* paper;  // what its section 5 says of it
};

// All but the last bands are laid over one another while others are still rendered: what is left when the
// slowest renderer is done is less than the stages after it take.
std::vector<Stage> stages_of(const deploy::Picture& picture) {
    const deploy::Seconds& s = picture.seconds;
    std::vector<double> beyond;
    for (const deploy::Seconds& frame : picture.each) {
        beyond.push_back(frame.total - frame.render);
    }
    const Spread left = spread(std::move(beyond));
    return {{"render", s.render, "0.25 s of 128^3 by four"},
            {"composite", s.composite, "10 ms an image laid over"},
            {"warp", s.warp, "part of render"},
            {"encode", s.encode, "1 ms"},
            {"beyond render", left.median, "10 ms, 1 ms, and the picture over 100 Mbit/s"},
            {"beyond, at least", left.least, ""},
            {"total", s.total, "0.44 s of 128^3 by four"}};
}

base::Status stages(const StagesFlags& flags) {
    const auto view = flags.common.view(flags.edge);
    if (!view) {
        return view.error();
    }
    auto report = Report::open("stages", flags.common.json);
    if (!report) {
        return report.error();
    }
    const Workload work = workload(flags.workload);
    auto tree = OnTree::start(work.cube(flags.edge), flags.tree[0], flags.tree[1], flags.common.threads);
    if (!tree) {
        return tree.error();
    }
    const auto picture = [&] {
        deploy::ProgressBar bar(flags.workload);
        return tree->draw_path(*view, flags.common.frames, work.tf, [&](double share) { bar.show(share); });
    }();
    if (!picture) {
        return picture.error();
    }
    for (const Stage& stage : stages_of(*picture)) {
        Record record;
        record.text("stage", stage.name, 17)
            .aside("cube", std::to_string(flags.edge) + "^3")
            .aside("workload", flags.workload)
            .aside("image", flags.common.image)
            .aside("nodes", tree->nodes())
            .aside("frames", flags.common.frames)
            .number("median_ms", stage.seconds * 1e3, 2)
            .number("per_cent", 100 * stage.seconds / picture->seconds.total, 1)
            .text("paper", stage.paper);
        report->add(record);
    }
    report->note("Windows: " + std::to_string(picture->window_bytes) +
                 " bytes up the tree; the picture: " + std::to_string(picture->frame_bytes) + " bytes.");
    return report->close();
}

}  // namespace

Run add_stages(CLI::App& app) {
    auto flags = std::make_shared<StagesFlags>();
    flags->common.image = "500x500";
    app.add_option("--tree", flags->tree, "branching and levels")
        ->delimiter(',')
        ->expected(2)
        ->allow_extra_args(false)
        ->type_name("B,LEVELS")
        ->default_str("2,3");
    add_size(app, flags->edge);
    add_workload(app, flags->workload);
    flags->common.add_frames(app);
    flags->common.add_image(app);
    flags->common.add_quality(app);
    flags->common.drawing.add_classify(app);
    flags->common.drawing.add_lod(app);
    flags->common.add_threads(app);
    flags->common.add_json(app);
    return [flags] { return status_of("stages", stages(*flags)); };
}

}  // namespace shearwater::bench
