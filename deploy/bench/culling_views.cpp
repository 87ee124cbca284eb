#include <algorithm>
#include <cmath>
#include <memory>

#include "common/culling/function_store.h"
#include "common/culling/polynomials.h"
#include "common/culling/rates.h"
#include "deploy/bench/culling.h"
#include "deploy/bench/culling_optimal.h"
#include "deploy/progress_bar.h"

namespace shearwater::bench {

namespace {

constexpr int views = 18;
constexpr double turn = 360.0 / views;

// Visible blocks of one view, or of all.
struct Visible {
    std::uint64_t opaque = 0, optimal = 0;
    std::array<std::uint64_t, culling_kinds.size()> kinds{};
    std::uint64_t polynomial = 0;  // opof, of functions as polynomials
    std::uint64_t by_rays = 0;     // of bricks
    std::uint64_t missed = 0;      // by a kind, of the optimal ones
    bool in_order = true;

    void add(const Visible& view) {
        opaque += view.opaque;
        optimal += view.optimal;
        for (std::size_t k = 0; k < kinds.size(); ++k) {
            kinds[k] += view.kinds[k];
        }
        polynomial += view.polynomial;
        by_rays += view.by_rays;
        missed += view.missed;
        in_order = in_order && view.in_order;
    }
};

// What holds of each block in all directions: a byte.
culling::FunctionTable least_of(const culling::FunctionTable& table) {
    culling::FunctionTable least = table;
    const std::size_t blocks = table.block_count();
    for (std::size_t n = 0; n < blocks; ++n) {
        std::uint8_t code = culling::most_code;
        for (std::size_t entry = n; entry < table.codes.size(); entry += blocks) {
            code = std::min(code, table.codes[entry]);
        }
        for (std::size_t entry = n; entry < table.codes.size(); entry += blocks) {
            least.codes[entry] = code;
        }
    }
    return least;
}

// What a culler has prepared in 41 bytes a block: columns as polynomials, and what is least of the block.
culling::FunctionStore as_polynomials(const CullingRun& run, const culling::Culler& culler) {
    const int side = culling::DirectionGrid::default_side;
    culling::FunctionStore store(run.grid(), culling::DirectionGrid(side));
    for (const culling::Member& member : culling::members_of(run.drawn.tf)) {
        for (const culling::Footprint footprint : culling::footprints_of(culling::Kind::opof)) {
            const culling::FunctionKey key{footprint, member.basis, 0};
            const culling::FunctionTable& table = *culler.functions().find(key);
            store.put(key, std::make_shared<culling::FunctionTable>(
                               footprint == culling::Footprint::block
                                   ? least_of(table)
                                   : culling::table_of(culling::polynomials_of(table), table.blocks, side)));
        }
    }
    return store;
}

Visible visible_of(const CullingRun& run, culling::Culler& culler, culling::FunctionStore& polynomials,
                   const view::Factorisation& f) {
    base::Workers& workers = run.cube.workers();
    const shear::BrickVolume& volume = run.cube.bricks();
    const culling::BlockGrid grid = run.grid();
    const auto classification = shear::classify(volume, run.drawn.tf, f.classify, workers);
    const culling::BlockSet opaque = opaque_blocks(volume, classification, grid);
    const culling::BlockSet optimal =
        optimal_blocks(volume, classification, f, grid, opaque, run.threshold, workers);
    Visible visible;
    visible.opaque = opaque.count();
    visible.optimal = optimal.count();
    for (std::size_t k = 0; k < culling_kinds.size(); ++k) {
        const auto blocks = culler.visible(f, run.drawn.tf, run.settings(culling_kinds[k]), workers).blocks;
        visible.kinds[k] = count_of_both(blocks, opaque);
        visible.missed += visible.optimal - count_of_both(blocks, optimal);
        visible.in_order = visible.in_order && (k == 0 || visible.kinds[k - 1] <= visible.kinds[k]);
    }
    const view::Vec3& spacing = run.cube.lattice().spacing;
    const std::vector<culling::BlockRates> rates =
        polynomials.rates(run.drawn.tf, culling::Kind::opof, 0, std::min({spacing.x, spacing.y, spacing.z}));
    const auto by_polynomials =
        culling::visible_blocks(f, grid, rates, run.settings(culling::Kind::opof), workers);
    visible.polynomial = count_of_both(by_polynomials, opaque);
    visible.missed += visible.optimal - count_of_both(by_polynomials, optimal);
    visible.by_rays = shear::render(volume, classification, f, workers).stats.bricks_rendered;
    return visible;
}

Record row(const CullingRun& run, const std::string& azimuth, const Visible& visible, int of) {
    const auto mean = [&](std::uint64_t blocks) { return static_cast<double>(blocks) / of; };
    const auto culled = [&](std::uint64_t blocks) -> std::optional<double> {
        if (visible.opaque == 0) {
            return std::nullopt;
        }
        return 100 - 100 * static_cast<double>(blocks) / static_cast<double>(visible.opaque);
    };
    const bool bricks_are_blocks = run.block == shear::BrickVolume::edge;
    const auto of_rays = [&](std::optional<double> value) {
        return bricks_are_blocks ? value : std::nullopt;
    };
    Record record = run.record();
    record.text("azimuth", azimuth)
        .aside("blocks", static_cast<double>(run.grid().size()))
        .aside("non_empty", mean(visible.opaque))
        .number("optimal", mean(visible.optimal), 0)
        .number("opof", mean(visible.kinds[0]), 0)
        .number("polynomial", mean(visible.polynomial), 0)
        .number("linear", mean(visible.kinds[1]), 0)
        .number("pof", mean(visible.kinds[2]), 0)
        .number("by_rays", of_rays(mean(visible.by_rays)), 0)
        .number("culled_%_optimal", culled(visible.optimal), 1)
        .number("opof_%", culled(visible.kinds[0]), 1)
        .number("polynomial_%", culled(visible.polynomial), 1)
        .number("linear_%", culled(visible.kinds[1]), 1)
        .number("pof_%", culled(visible.kinds[2]), 1)
        .number("by_rays_%", of_rays(culled(visible.by_rays)), 1)
        .text("in_order", visible.in_order ? "yes" : "no")
        .count("missed", visible.missed);
    return record;
}

}  // namespace

void culling_views(const CullingRun& run) {
    culling::Culler culler = run.culler();
    {
        deploy::ProgressBar bar("functions");
        for (std::size_t k = 0; k < culling_kinds.size(); ++k) {
            culler.prepare(run.drawn.tf, culling_kinds[k], 0, run.cube.workers());
            bar.show(static_cast<double>(k + 1) / culling_kinds.size());
        }
    }
    culling::FunctionStore polynomials = as_polynomials(run, culler);
    run.report.table("views", "Visible blocks of " + std::to_string(run.block) + "^3 cells: " + run.title() +
                                  ", " + std::to_string(run.grid().size()) +
                                  " blocks; by_rays: bricks that rays come to before they end");
    deploy::ProgressBar bar("views");
    Visible all;
    for (int n = 0; n < views; ++n) {
        const Visible visible = visible_of(run, culler, polynomials, run.factorisation(n * turn));
        all.add(visible);
        const double azimuth = run.view.orbit.azimuth + n * turn;
        run.report.add(row(run, std::to_string(std::lround(azimuth)), visible, 1));
        bar.show(static_cast<double>(n + 1) / views);
    }
    run.report.add(row(run, "mean", all, views));
    run.report.note(std::to_string(all.opaque / views) +
                    " blocks are not empty. opof culls at least what opof-linear does, "
                    "and that at least what pof does, in every view: " +
                    (all.in_order ? "yes" : "no") + ".");
}

}  // namespace shearwater::bench
