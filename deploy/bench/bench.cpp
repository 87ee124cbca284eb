// shearwater bench: how fast pictures are drawn here, beside the figures of the DVR paper.

#include <CLI/CLI.hpp>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "deploy/bench/subcommands.h"
#include "protocol/daemon/runtime.h"

namespace shearwater::deploy {

Run add_bench(CLI::App& app) {
    using Add = Run (*)(CLI::App&);
    const std::vector<std::tuple<const char*, const char*, Add>> benchmarks{
        {"kernels", "the inner loop alone, by each kind of vectors that this processor has",
         bench::add_kernels},
        {"frame", "frames in one process, by stage", bench::add_frame},
        {"trees", "frames by trees of 3 to 31 local daemons: the paper's Table 1", bench::add_trees},
        {"images", "frames of several sizes: the paper's Table 2", bench::add_images},
        {"stages", "where the time of a tree's frame goes: the paper's Figure 8", bench::add_stages},
        {"load", "from a file in the page cache to bricks, by stage", bench::add_load},
        {"codecs", "what is done to pixels between kernel and window", bench::add_codecs},
        {"large", "a cube that no file holds: the paper's run of 2048^3 voxels", bench::add_large},
        {"culling", "what leaving out hidden blocks saves: the papers' figures on visibility",
         bench::add_culling},
    };
    app.require_subcommand(0, 1);
    auto runs = std::make_shared<std::vector<std::pair<CLI::App*, Run>>>();
    for (const auto& [name, about, add] : benchmarks) {
        CLI::App* const benchmark = app.add_subcommand(name, about);
        runs->emplace_back(benchmark, add(*benchmark));
    }
    return [runs] {
        for (const auto& [benchmark, run] : *runs) {
            if (benchmark->parsed()) {
                return run();
            }
        }
        return daemon::refuse(
            "shearwater bench",
            base::error(base::Code::invalid_argument, "", "name a benchmark; see shearwater bench --help"));
    };
}

}  // namespace shearwater::deploy
