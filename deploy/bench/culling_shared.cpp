#include <algorithm>

#include "deploy/bench/culling.h"
#include "deploy/bench/many_blocks.h"
#include "deploy/bench/timing.h"

namespace shearwater::bench {

base::Status culling_shared(const deploy::ViewOptions& view, double threshold, int frames, Report& report) {
    if (auto fits = ManyBlocks::check_memory(); !fits) {
        return fits;
    }
    report.table("shared", "Deciding what is visible, opof, shared over renderers of one thread each: " +
                               ManyBlocks::title());
    base::Workers one(1);
    for (const MadeUp& codes : made_up) {
        ManyBlocks blocks(codes, view);
        for (const int renderers : {1, 2, 4, 8, 16, 32}) {
            std::vector<double> slowest, all;
            for (int n = 0; n < frames; ++n) {
                const view::Factorisation f = blocks.factorisation(n, false);
                // What is found once for all views is not the passes' time.
                blocks.visible(f, threshold, one);
                double most = 0, sum = 0;
                for (int part = 0; part < renderers; ++part) {
                    Clock clock;
                    blocks.visible(f, threshold, one, {part, renderers});
                    const double seconds = clock.lap();
                    most = std::max(most, seconds);
                    sum += seconds;
                }
                slowest.push_back(most);
                all.push_back(sum);
            }
            Record record;
            record.text("codes", codes.name)
                .aside("image", view.size)
                .count("blocks", blocks.size())
                .count("renderers", static_cast<std::uint64_t>(renderers))
                .number("slowest_ms", 1e3 * spread(std::move(slowest)).median, 3)
                .number("together_ms", 1e3 * spread(std::move(all)).median, 3);
            report.add(record);
        }
    }
    return {};
}

}  // namespace shearwater::bench
