#include "deploy/bench/culling.h"
#include "deploy/bench/paper.h"
#include "deploy/progress_bar.h"

namespace shearwater::bench {

namespace {

// One hat over low values and one over high ones.
view::TransferFunction of_heights(double low, double high) {
    return {.opacity_pins = {view::Hat{.centre = 0.2, .top = 0.4, .base = 0.6, .height = low},
                             view::Hat{.centre = 0.75, .top = 0.4, .base = 0.5, .height = high}},
            .colour_pins = {{0, {1, 0.8, 0.6}}, {1, {1, 1, 1}}},
            .background = {}};
}

}  // namespace

void culling_family(const CullingRun& run) {
    base::Workers& workers = run.cube.workers();
    culling::Culler culler = run.culler();
    run.report.table("family", "Two bases, opof: " + run.title() + ", blocks of " +
                                   std::to_string(run.block) +
                                   "^3; functions of blocks, computed and when all is asked for again");
    const view::Factorisation f = run.factorisation(0);
    struct Setting {
        const paper::Family& of;
        view::TransferFunction tf;
        std::int64_t computed;
    };
    std::vector<Setting> settings;
    deploy::ProgressBar bar("functions");
    for (const paper::Family& of : paper::families) {
        const auto tf = of_heights(of.low, of.high);
        settings.push_back({of, tf, culler.prepare(tf, culling::Kind::opof, f.level(), workers)});
        bar.show(static_cast<double>(settings.size()) / paper::families.size());
    }
    for (const Setting& setting : settings) {
        const std::int64_t again = culler.prepare(setting.tf, culling::Kind::opof, f.level(), workers);
        const auto classification = shear::classify(run.cube.bricks(), setting.tf, f.classify, workers);
        const culling::BlockSet opaque = opaque_blocks(run.cube.bricks(), classification, run.grid());
        const std::uint64_t visible = count_of_both(
            culler.visible(f, setting.tf, run.settings(culling::Kind::opof), workers).blocks, opaque);
        const std::uint64_t non_empty = opaque.count();
        Record record = run.record();
        record.number("low", setting.of.low, 2)
            .number("high", setting.of.high, 2)
            .count("non_empty", non_empty)
            .count("visible", visible)
            .count("culled", non_empty - visible)
            .number("culled_%",
                    non_empty == 0 ? std::nullopt
                                   : std::optional(100.0 * static_cast<double>(non_empty - visible) /
                                                   static_cast<double>(non_empty)),
                    1)
            .number("paper_%", 100.0 * setting.of.culled / (setting.of.culled + setting.of.visible), 1)
            .count("computed", static_cast<std::uint64_t>(setting.computed))
            .count("again", static_cast<std::uint64_t>(again));
        run.report.add(record);
    }
}

}  // namespace shearwater::bench
