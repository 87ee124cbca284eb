#include <algorithm>

#include "deploy/bench/culling.h"
#include "deploy/bench/on_tree.h"
#include "deploy/bench/timing.h"
#include "deploy/progress_bar.h"

namespace shearwater::bench {

namespace {

// A dense hat whose middle moves from one picture to the next.
view::TransferFunction hat_at(double centre) {
    return {.opacity_pins = {view::Hat{.centre = centre, .top = 0.3, .base = 0.5, .height = 0.9}},
            .colour_pins = {{0, {0.2, 0.3, 1}}, {1, {1, 0.8, 0.3}}},
            .background = {}};
}

double percentile_95(std::vector<double> values) {
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(0.95 * static_cast<double>(values.size() - 1))];
}

}  // namespace

base::Status culling_drag(const Case& drawn, const deploy::ViewOptions& view, double threshold, int frames,
                          int threads, Report& report) {
    constexpr int rounds = 4;
    // The hat rests at first, for longer than until its functions are asked for: they are being found when it
    // begins to move.
    constexpr int resting = 30;
    auto tree = OnTree::start(drawn.cube, 2, 2, threads);
    if (!tree) {
        return tree.error();
    }
    report.table("drag", "Pictures while a hat is dragged, its centre another in each: " + drawn.name + ", " +
                             view.size + ", a tree of " + std::to_string(tree->nodes()) + " nodes");
    const std::array<std::string, 2> kinds{"off", "opof"};
    std::array<std::vector<double>, kinds.size()> times;
    deploy::ProgressBar bar("pictures");
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
            deploy::ViewOptions seen = view;
            seen.drawing.culling = kinds[kind];
            seen.drawing.culling_threshold = threshold;
            const double from = 0.3 + 0.02 * round;
            const deploy::Script script{
                .pictures = resting + frames,
                .shot = [&](int index, const deploy::KnownCube& cube) -> base::Result<flight::Shot> {
                    const auto camera = seen.camera(cube.lattice);
                    if (!camera) {
                        return camera.error();
                    }
                    return flight::Shot{*camera, hat_at(from + 0.01 * std::max(index + 1 - resting, 0))};
                }};
            const auto picture = tree->draw(seen, script, [](double) {});
            if (!picture) {
                return picture.error();
            }
            for (auto each = picture->each.begin() + resting; each != picture->each.end(); ++each) {
                times[kind].push_back(each->total);
            }
            bar.show((round + (static_cast<double>(kind) + 1) / kinds.size()) / rounds);
        }
    }
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        const Spread all = spread(times[kind]);
        Record record;
        record.aside("workload", drawn.name)
            .text("culling", kinds[kind], 11)
            .count("pictures", times[kind].size())
            .number("median_ms", 1e3 * all.median, 2)
            .number("percentile_95_ms", 1e3 * percentile_95(times[kind]), 2)
            .number("min_ms", 1e3 * all.least, 2)
            .number("max_ms", 1e3 * all.most, 2);
        report.add(record);
    }
    return {};
}

}  // namespace shearwater::bench
