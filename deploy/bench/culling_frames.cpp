#include <optional>

#include "deploy/bench/culling.h"
#include "deploy/bench/workload.h"
#include "deploy/progress_bar.h"

namespace shearwater::bench {

void culling_frames(const CullingRun& run) {
    culling::Culler culler = run.culler();
    std::array<std::optional<Culling>, culling_kinds.size() + 1> ways;  // the first: without
    for (std::size_t k = 0; k < culling_kinds.size(); ++k) {
        ways[k + 1].emplace(culler, run.settings(culling_kinds[k]));
    }
    std::array<std::vector<FrameTimes>, ways.size()> frames;
    run.report.table("frames", "Frames: " + run.title() + ", " + run.view.size);
    {
        deploy::ProgressBar bar("frames");
        // By turns, so that a slow phase of the machine falls on all of them.
        for (int n = -1; n < run.frames; ++n) {
            const view::Camera camera = run.camera(n * Path::turn);
            for (std::size_t way = 0; way < ways.size(); ++way) {
                const FrameTimes times = run.cube.draw(camera, run.size(), run.view.sampling(), run.drawn.tf,
                                                       ways[way] ? &*ways[way] : nullptr);
                if (n >= 0) {
                    frames[way].push_back(times);
                }
            }
            bar.show(static_cast<double>(n + 2) / (run.frames + 1));
        }
    }
    for (std::size_t way = 0; way < ways.size(); ++way) {
        const FrameSummary all = summary(frames[way]);
        Record record = run.record();
        record.text("culling", way == 0 ? "off" : name_of(culling_kinds[way - 1]), 11)
            .aside("frames", run.frames)
            .number("median_s", all.total.median, 5)
            .number("min_s", all.total.least, 5)
            .number("max_s", all.total.most, 5)
            .aside("samples", all.samples)
            .number("Msamples", all.samples / 1e6, 2)
            .number("cull_s", all.cull, 5)
            .number("render_s", all.render, 5)
            .number("warp_s", all.warp, 5);
        run.report.add(record);
    }
}

}  // namespace shearwater::bench
