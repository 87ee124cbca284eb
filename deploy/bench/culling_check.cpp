#include <algorithm>
#include <optional>
#include <random>

#include "deploy/bench/culled_pictures.h"
#include "deploy/bench/culling.h"
#include "deploy/progress_bar.h"

namespace shearwater::bench {

namespace {

struct Found {
    int pictures = 0, over = 0;
    double greatest = 0;
    std::uint64_t culled = 0, opaque = 0;
};

}  // namespace

bool culling_check(const CullingRun& run, int pictures) {
    // Half a level at the default threshold, and what rounding adds.
    const double bound = std::max(1.0 / 255, 1 - run.threshold);
    run.report.table("check",
                     "Pictures at random with culling and without: " + run.drawn.name + ", " + run.view.size);
    std::array<Found, culling_kinds.size()> found;
    std::optional<int> worst;
    double greatest = 0;
    {
        deploy::ProgressBar bar("pictures");
        std::mt19937 random(1);
        for (int n = 0; n < pictures; ++n) {
            const auto tf = function_at_random(random);
            const auto camera = camera_at_random(random, run.cube.lattice());
            const auto sampling = sampling_at_random(random);
            const std::size_t kind = static_cast<std::size_t>(n) % culling_kinds.size();
            culling::Culler culler = run.culler();
            const CulledPicture picture =
                compare(run.cube.bricks(), culler, run.settings(culling_kinds[kind]), tf, camera, run.size(),
                        run.cube.lattice(), sampling, run.cube.workers());
            Found& all = found[kind];
            ++all.pictures;
            all.over += picture.difference <= bound ? 0 : 1;
            all.greatest = std::max(all.greatest, picture.difference);
            all.culled += picture.with.bricks_culled;
            all.opaque += picture.with.bricks_total - picture.with.bricks_empty;
            if (!(picture.difference <= greatest)) {
                greatest = picture.difference;
                worst = n;
            }
            bar.show(static_cast<double>(n + 1) / pictures);
        }
    }
    bool none_over = true;
    for (std::size_t kind = 0; kind < found.size(); ++kind) {
        const Found& all = found[kind];
        Record record = run.record();
        record.text("culling", name_of(culling_kinds[kind]), 11)
            .count("pictures", static_cast<std::uint64_t>(all.pictures))
            .number("greatest_difference", all.greatest, 6)
            .number("bound", bound, 6)
            .count("over", static_cast<std::uint64_t>(all.over))
            .number("culled_%",
                    all.opaque == 0 ? std::nullopt
                                    : std::optional(100.0 * static_cast<double>(all.culled) /
                                                    static_cast<double>(all.opaque)),
                    1);
        run.report.add(record);
        none_over = none_over && all.over == 0;
    }
    if (worst) {
        run.report.note("The greatest difference is picture " + std::to_string(*worst) + "'s, of the " +
                        std::to_string(pictures) + " from 0 on.");
    }
    return none_over;
}

}  // namespace shearwater::bench
