#include "deploy/bench/culling.h"
#include "deploy/bench/many_blocks.h"
#include "deploy/bench/workload.h"
#include "deploy/progress_bar.h"

namespace shearwater::bench {

namespace {

struct PassTimes {
    double first = 0;    // of an edited transfer function
    Spread turning{};    // of the same from one view to the next
    Spread standing{};   // of one view over and over
    double visible = 0;  // blocks, on average
};

// `factorise` gives a view's factorisation, so many steps along the path; `pass` is measured.
PassTimes times_of(int frames, const std::function<view::Factorisation(int)>& factorise,
                   const std::function<culling::BlockSet(const view::Factorisation&)>& pass) {
    PassTimes times;
    std::vector<double> turning, standing;
    for (int n = 0; n <= frames; ++n) {
        const view::Factorisation f = factorise(n);
        Clock clock;
        const culling::BlockSet visible = pass(f);
        const double seconds = clock.lap();
        pass(f);
        standing.push_back(clock.lap());
        if (n == 0) {
            times.first = seconds;
        } else {
            turning.push_back(seconds);
        }
        times.visible += static_cast<double>(visible.count()) / (frames + 1);
    }
    times.turning = spread(std::move(turning));
    times.standing = spread(std::move(standing));
    return times;
}

void add_times(Record& record, const PassTimes& times) {
    record.number("visible", times.visible, 0)
        .number("first_ms", 1e3 * times.first, 3)
        .number("turned_ms", 1e3 * times.turning.median, 3)
        .number("min_turned_ms", 1e3 * times.turning.least, 3)
        .number("median_ms", 1e3 * times.standing.median, 3)
        .number("min_ms", 1e3 * times.standing.least, 3);
}

}  // namespace

void culling_pass(const CullingRun& run) {
    run.report.table("pass", "Deciding what is visible: " + run.title() + ", " +
                                 std::to_string(run.grid().size()) + " blocks");
    for (const culling::Kind kind : culling_kinds) {
        culling::Culler culler = run.culler();
        culler.prepare(run.drawn.tf, kind, 0, run.cube.workers());
        const PassTimes times = times_of(
            run.frames, [&](int n) { return run.factorisation(n * Path::turn); },
            [&](const view::Factorisation& f) {
                return culler.visible(f, run.drawn.tf, run.settings(kind), run.cube.workers()).blocks;
            });
        Record record = run.record();
        record.text("culling", name_of(kind), 11).count("blocks", run.grid().size());
        add_times(record, times);
        run.report.add(record);
    }
}

base::Status culling_pass_of_many(const deploy::ViewOptions& view, double threshold, int frames,
                                  base::Workers& workers, Report& report) {
    if (auto fits = ManyBlocks::check_memory(); !fits) {
        return fits;
    }
    report.table("pass-many", "Deciding what is visible, opof: " + ManyBlocks::title());
    for (const MadeUp& codes : made_up) {
        ManyBlocks blocks(codes, view);
        for (const bool parallel : {false, true}) {
            const PassTimes times = times_of(
                frames, [&](int n) { return blocks.factorisation(n, parallel); },
                [&](const view::Factorisation& f) { return blocks.visible(f, threshold, workers); });
            Record record;
            record.text("codes", codes.name)
                .text("view", parallel ? "parallel" : "perspective", 11)
                .aside("image", view.size)
                .count("threads", static_cast<std::uint64_t>(workers.threads()))
                .count("blocks", blocks.size());
            add_times(record, times);
            report.add(record);
        }
    }
    return {};
}

}  // namespace shearwater::bench
