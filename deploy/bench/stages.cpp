// bench stages: the paper's Figure 8, where the time of one frame goes.

#include "deploy/bench/path_on_tree.h"
#include "deploy/bench/report.h"
#include "deploy/bench/subcommands.h"
#include "deploy/bench/timing.h"

namespace shearwater::bench {
namespace {

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

base::Status stages(const PathOnTree& flags) {
    auto report = Report::open("stages", flags.common.json);
    if (!report) {
        return report.error();
    }
    const auto drawn = flags.draw();
    if (!drawn) {
        return drawn.error();
    }
    const deploy::Picture& picture = drawn->picture;
    for (const Stage& stage : stages_of(picture)) {
        Record record;
        record.text("stage", stage.name, 17)
            .aside("cube", std::to_string(flags.edge) + "^3")
            .aside("workload", flags.workload)
            .aside("image", flags.common.image)
            .aside("nodes", drawn->nodes)
            .aside("frames", flags.common.frames)
            .number("median_ms", stage.seconds * 1e3, 2)
            .number("per_cent", 100 * stage.seconds / picture.seconds.total, 1)
            .text("paper", stage.paper);
        report->add(record);
    }
    report->note("Windows: " + std::to_string(picture.window_bytes) +
                 " bytes up the tree; the picture: " + std::to_string(picture.frame_bytes) + " bytes.");
    return report->close();
}

}  // namespace

Run add_stages(CLI::App& app) {
    auto flags = std::make_shared<PathOnTree>(PathOnTree{.common = {}, .tree = {2, 3}, .edge = 256});
    flags->common.image = "500x500";
    add_size(app, flags->edge);
    flags->add_to(app);
    return [flags] { return status_of("stages", stages(*flags)); };
}

}  // namespace shearwater::bench
