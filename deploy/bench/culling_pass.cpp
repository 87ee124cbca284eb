#include <random>

#include "common/culling/function_store.h"
#include "deploy/bench/culling.h"
#include "deploy/bench/machine.h"
#include "deploy/bench/options.h"
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

// A cube of functions without voxels.
constexpr std::int64_t many_edge = 2048;

culling::FunctionTable made_up(const culling::BlockGrid& grid, const culling::DirectionGrid& directions,
                               int codes) {
    culling::FunctionTable table{.blocks = {{}, grid.counts()}, .side = directions.side(), .codes = {}};
    table.codes.resize(grid.size() * static_cast<std::size_t>(directions.cells()));
    std::mt19937 random(1);
    for (std::uint8_t& code : table.codes) {
        code = static_cast<std::uint8_t>((random() >> 8) % static_cast<unsigned>(codes));
    }
    return table;
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
    const view::Lattice lattice{.n = {many_edge, many_edge, many_edge}, .spacing = {1, 1, 1}};
    const culling::BlockGrid grid(lattice.n);
    const culling::DirectionGrid directions(culling::DirectionGrid::default_side);
    const auto bytes = grid.size() * static_cast<std::size_t>(directions.cells());
    if (auto fits = check_memory("decide what is visible of " + cube_text(lattice.n), 3 * bytes); !fits) {
        return fits;
    }
    // Of two bases, both made up as one.
    const view::TransferFunction one{
        .opacity_pins = {view::Hat{0.25, 0, 0.5, 1}}, .colour_pins = {{0, {1, 1, 1}}}, .background = {}};
    view::TransferFunction two = one;
    two.opacity_pins.push_back(view::Hat{0.75, 0, 0.5, 1});
    report.table("pass-many", "Deciding what is visible, opof: " + cube_text(lattice.n) + ", " +
                                  std::to_string(grid.size()) + " blocks with codes at random");
    struct Codes {
        const char* name;
        int count;
        const view::TransferFunction& tf;
    };
    // As dense as they come, and so thin that every ray goes through.
    for (const Codes& codes : {Codes{"dense", 256, one}, Codes{"thin", 64, one}, Codes{"of two", 64, two}}) {
        culling::FunctionStore store(grid, directions);
        const auto table = std::make_shared<culling::FunctionTable>(made_up(grid, directions, codes.count));
        for (const culling::Member& member : culling::members_of(codes.tf)) {
            for (const culling::Footprint footprint : culling::footprints_of(culling::Kind::opof)) {
                store.put({footprint, member.basis, 0}, table);
            }
        }
        for (const bool parallel : {false, true}) {
            deploy::ViewOptions seen = first_view(many_edge);
            seen.size = view.size;
            seen.quality = view.quality;
            seen.drawing.lod = "off";
            seen.parallel = parallel;
            const PassTimes times = times_of(
                frames,
                [&](int n) {
                    deploy::ViewOptions turned = seen;
                    turned.orbit.azimuth += n * Path::turn;
                    return view::factorise(*turned.camera(lattice), *turned.image_size(), lattice,
                                           turned.sampling());
                },
                [&](const view::Factorisation& f) {
                    return culling::visible_blocks(f, grid, store.rates(codes.tf, culling::Kind::opof, 0, 1),
                                                   {culling::Kind::opof, threshold}, workers);
                });
            Record record;
            record.text("codes", codes.name)
                .text("view", parallel ? "parallel" : "perspective", 11)
                .aside("image", view.size)
                .count("threads", static_cast<std::uint64_t>(workers.threads()))
                .count("blocks", grid.size());
            add_times(record, times);
            report.add(record);
        }
    }
    return {};
}

}  // namespace shearwater::bench
