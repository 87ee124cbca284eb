#include <ctime>

#include "common/culling/family.h"
#include "common/culling/polynomials.h"
#include "deploy/bench/culling.h"
#include "deploy/bench/paper.h"
#include "deploy/progress_bar.h"

namespace shearwater::bench {

void culling_functions(const CullingRun& run) {
    const auto members = culling::members_of(run.drawn.tf);
    if (members.empty()) {
        run.report.note("\nThe transfer function has no basis to compute functions of.");
        return;
    }
    const culling::BlockGrid grid = run.grid();
    const auto blocks = static_cast<double>(grid.size());
    run.report.table("functions", "One basis's opacity functions: " + run.title() + ", " +
                                      std::to_string(grid.size()) + " blocks of " +
                                      std::to_string(run.block) + "^3");
    struct From {
        const char* name;
        bool octants;
    };
    deploy::ProgressBar bar("functions");
    double done = 0;
    for (const culling::Footprint footprint : {culling::Footprint::column, culling::Footprint::block}) {
        for (const From from : {From{"octants", true}, From{"voxels", false}}) {
            for (const int side : {12, 24, 36}) {
                const culling::DirectionGrid directions(side);
                const culling::FunctionKey key{footprint, members[0].basis, 0};
                Clock clock;
                const std::clock_t before = std::clock();
                const culling::FunctionTable table = culling::functions_of(
                    run.cube.bricks(), key, grid, directions, from.octants, run.cube.workers());
                const double seconds = clock.lap();
                const double processor_seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
                Record record = run.record();
                record.text("functions", footprint == culling::Footprint::column ? "columns" : "blocks", 9)
                    .text("from", from.name, 7)
                    .count("side", static_cast<std::uint64_t>(side))
                    .count("directions", static_cast<std::uint64_t>(directions.cells()))
                    .number("seconds", seconds, 3)
                    .number("processor_ms_a_block", 1e3 * processor_seconds / blocks, 3)
                    .number("paper_ms_a_block",
                            side == 36 ? std::optional(paper::function_processor_ms) : std::nullopt, 0)
                    .number("bytes_a_block", static_cast<double>(table.codes.size()) / blocks, 0)
                    .number("paper_bytes", side == 36 ? std::optional(paper::function_bytes) : std::nullopt,
                            0)
                    .number("MB", static_cast<double>(table.codes.size()) / 1e6, 2);
                const std::clock_t fitting = std::clock();
                const auto polynomials = culling::polynomials_of(table);
                record
                    .number("polynomial_ms_a_block",
                            1e3 * static_cast<double>(std::clock() - fitting) / CLOCKS_PER_SEC / blocks, 4)
                    .count("polynomial_bytes", sizeof(culling::Polynomial))
                    .count("paper_polynomial", 40);
                run.report.add(record);
                bar.show(++done / 12);
            }
        }
    }
}

}  // namespace shearwater::bench
