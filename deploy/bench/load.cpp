// bench load: how fast a cube in the page cache becomes bricks and is seen, and how soon that ends when told
// to.

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>

#include "common/cube/open.h"
#include "common/volume/levels.h"
#include "common/volume/quantiser.h"
#include "common/volume/statistics.h"
#include "deploy/bench/machine.h"
#include "deploy/bench/options.h"
#include "deploy/bench/report.h"
#include "deploy/bench/stopping.h"
#include "deploy/bench/subcommands.h"
#include "deploy/bench/timing.h"
#include "deploy/first_look.h"
#include "deploy/progress_bar.h"
#include "deploy/samples/sample.h"
#include "protocol/daemon/interrupt.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/render.h"
#include "renderer/shear/sketch.h"

namespace shearwater::bench {
namespace {

struct LoadFlags {
    Options common;
    std::string path;
    std::string folder;
    std::int64_t edge = 256;
    int bits = 8;
};

// A file of our own, removed with its folder.
class Scratch {
  public:
    explicit Scratch(const std::filesystem::path& in) {
        std::string pattern = (in / "shearwater-bench-XXXXXX").string();
        if (mkdtemp(pattern.data()) != nullptr) {
            folder_ = pattern;
        }
    }
    ~Scratch() {
        std::error_code ignored;
        if (!folder_.empty()) {
            std::filesystem::remove_all(folder_, ignored);
        }
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    std::string cube() const { return (folder_ / "cube.fits").string(); }
    bool made() const { return !folder_.empty(); }

  private:
    std::filesystem::path folder_;
};

// Reads the whole cube a slab of planes at a time, handing each on.
base::Status read_slabs(cube::Cube& cube, const std::function<void(std::span<const float>)>& use) {
    const auto& n = cube.info.n;
    constexpr std::int64_t slab_voxels = std::int64_t{8} << 20;
    const std::int64_t planes = std::clamp<std::int64_t>(slab_voxels / (n[0] * n[1]), 1, n[2]);
    std::vector<float> values(static_cast<std::size_t>(n[0] * n[1] * planes));
    for (std::int64_t z = 0; z < n[2]; z += planes) {
        const volume::Box slab{{0, 0, z}, {n[0] - 1, n[1] - 1, std::min(z + planes, n[2]) - 1}};
        const std::span part(values.data(), static_cast<std::size_t>(slab.voxels()));
        if (auto read = cube.source->read(slab, part); !read) {
            return read;
        }
        use(part);
    }
    return {};
}

// Quantises values that lie in memory, in pieces that the workers share.
void quantise(const volume::Quantiser& quantiser, std::span<const float> values,
              std::span<std::uint8_t> codes8, std::span<std::uint16_t> codes16, base::Workers& workers) {
    constexpr std::size_t piece = std::size_t{1} << 16U;
    workers.for_each(static_cast<std::int64_t>((values.size() + piece - 1) / piece), [&](std::int64_t i) {
        const std::size_t first = static_cast<std::size_t>(i) * piece;
        const std::size_t count = std::min(piece, values.size() - first);
        if (codes16.empty()) {
            quantiser.codes(values.subspan(first, count), codes8.subspan(first, count));
        } else {
            quantiser.codes(values.subspan(first, count), codes16.subspan(first, count));
        }
    });
}

class Loading {
  public:
    Loading(const LoadFlags& flags, cube::Cube cube, Report& report)
        : flags_(flags), cube_(std::move(cube)), report_(report), workers_(flags.common.threads) {}

    base::Status run() {
        const auto ignore = [](std::span<const float>) {};
        if (auto warm = read_slabs(cube_, ignore); !warm) {
            return warm;
        }
        base::Status done;
        time("read", 1, [&] { done = read_slabs(cube_, ignore); });
        if (!done) {
            return done;
        }
        auto histogram =
            volume::count_values(*cube_.source, volume::whole(cube_.info.n), cube_.info.n, workers_);
        const double count_seconds = time("read and count", workers_.threads(), [&] {
            histogram =
                volume::count_values(*cube_.source, volume::whole(cube_.info.n), cube_.info.n, workers_);
        });
        if (!histogram) {
            return histogram.error();
        }
        const volume::Limits limits = volume::percentile_limits(*histogram, 99.5);
        const volume::Mapping mapping{.lo = limits.lo, .hi = limits.hi, .bits = flags_.bits};
        time_quantising(mapping);
        std::optional<shear::BrickVolume> bricks;
        const double brick_seconds = time("bricks from the file", workers_.threads(), [&] {
            bricks.reset();
            auto made = load_bricks(*cube_.source, mapping, {});
            done = made ? base::Status{} : made.error();
            bricks = made ? std::optional(*std::move(made)) : std::nullopt;
        });
        if (!done) {
            return done;
        }
        time_frames(*bricks);
        bricks.reset();
        time_stopped("stop: bricks", brick_seconds, [&](volume::VoxelSource& source, const auto& stop) {
            static_cast<void>(load_bricks(source, mapping, stop));
        });
        time_stopped("stop: count", count_seconds, [&](volume::VoxelSource& source, const auto& stop) {
            static_cast<void>(
                volume::count_values(source, volume::whole(cube_.info.n), cube_.info.n, workers_, {}, stop));
        });
        time_sketch(mapping);
        return time_first_look();
    }

  private:
    // Returns the median.
    double time(const std::string& stage, int threads, const std::function<void()>& work) {
        deploy::ProgressBar bar(stage);
        bar.show(0);
        const Spread times = measure_times(flags_.common.frames, work);
        add(stage, threads, voxels(), times);
        return times.median;
    }

    double voxels() const { return static_cast<double>(volume::voxel_count(cube_.info.n)); }

    base::Result<shear::BrickVolume> load_bricks(volume::VoxelSource& source, const volume::Mapping& mapping,
                                                 const std::stop_token& stop) {
        return shear::BrickVolume::load(source, volume::whole(cube_.info.n), cube_.info.n, mapping, workers_,
                                        {}, stop);
    }

    // Of work on the cube, which is opened first, as daemons do it, so that reading is stopped too.
    void time_stopped(const std::string& stage, double seconds,
                      const std::function<void(volume::VoxelSource&, const std::stop_token&)>& work) {
        deploy::ProgressBar bar(stage);
        bar.show(0);
        const Spread times = time_to_stop(seconds, flags_.common.frames, [&](const std::stop_token& stop) {
            if (const auto cube = cube::open(cube_.info.path, {.stop = stop})) {
                work(*cube->source, stop);
            }
        });
        add(stage, workers_.threads(), std::nullopt, times);
    }

    // Where the source gives single rows: from the file to what can be drawn.
    void time_sketch(const volume::Mapping& mapping) {
        const int level = volume::sketch_level(cube_.info.n);
        if (level == 0 || !cube_.source->gives_rows()) {
            return;
        }
        const auto sketch = [&](volume::VoxelSource& source, const std::stop_token& stop) {
            const auto read =
                shear::Sketch::read(source, volume::whole(cube_.info.n), cube_.info.n, level, workers_, stop);
            if (read) {
                const volume::Histogram histogram = read->histogram();
                const shear::BrickVolume volume = read->volume(mapping, workers_);
            }
        };
        const Spread times = measure_times(flags_.common.frames, [&] { sketch(*cube_.source, {}); });
        add("sketch", workers_.threads(), std::nullopt, times);
        time_stopped("stop: sketch", times.median, sketch);
    }

    // A frame that takes long: a large one, of high quality, in which every voxel counts.
    void time_frames(const shear::BrickVolume& bricks) {
        const view::Lattice lattice{.n = cube_.info.n, .spacing = {1, 1, 1}};
        const view::Factorisation factorisation =
            view::factorise(view::camera_on({}, lattice), {.width = 1024, .height = 1024}, lattice,
                            view::sampling(view::Quality::high));
        const auto draw = [&](const std::stop_token& stop) {
            shear::render(bricks, factorisation, view::default_transfer_function(), workers_, {.stop = stop});
        };
        const Spread times = measure_times(flags_.common.frames, [&] { draw({}); });
        add("frame", workers_.threads(), std::nullopt, times);
        add("stop: frame", workers_.threads(), std::nullopt,
            time_to_stop(times.median, flags_.common.frames, draw));
    }

    // By daemons that are started for it.
    base::Status time_first_look() {
        options::CubeOptions cube;
        cube.path = cube_.info.path;
        cube.bits = flags_.bits;
        std::vector<double> first, whole;
        bool sketch = false;
        for (int i = 0; i < flags_.common.frames; ++i) {
            const auto seen = deploy::first_look(cube, 2, flags_.common.threads);
            if (!seen) {
                return seen.error();
            }
            first.push_back(seen->first);
            whole.push_back(seen->whole);
            sketch = sketch || seen->sketch;
        }
        if (sketch) {
            add("first picture", workers_.threads(), std::nullopt, spread(std::move(first)));
        }
        add("picture of all", workers_.threads(), std::nullopt, spread(std::move(whole)));
        return {};
    }

    // One slab over and over: its values are in memory, as they are when a file has just been read.
    void time_quantising(const volume::Mapping& mapping) {
        constexpr std::size_t most = std::size_t{8} << 20U;
        std::vector<float> values;
        const auto keep = [&](std::span<const float> part) {
            const std::size_t room = most - std::min(most, values.size());
            values.insert(values.end(), part.begin(),
                          part.begin() + static_cast<std::ptrdiff_t>(std::min(room, part.size())));
        };
        if (!read_slabs(cube_, keep)) {
            return;
        }
        const volume::Quantiser quantiser(mapping);
        std::vector<std::uint8_t> codes8(mapping.bits == 8 ? values.size() : 0);
        std::vector<std::uint16_t> codes16(mapping.bits == 16 ? values.size() : 0);
        const Spread times = measure_times(flags_.common.frames,
                                           [&] { quantise(quantiser, values, codes8, codes16, workers_); });
        add("quantise in memory", workers_.threads(), static_cast<double>(values.size()), times);
    }

    void add(const std::string& stage, int threads, std::optional<double> voxels, const Spread& times) {
        const auto rate = [&](double per_voxel) {
            return voxels ? std::optional(*voxels * per_voxel / times.median / 1e6) : std::nullopt;
        };
        Record record;
        record.text("stage", stage, 20)
            .text("cube", cube_text(cube_.info.n))
            .count("bits", static_cast<std::uint64_t>(flags_.bits))
            .count("threads", static_cast<std::uint64_t>(threads))
            .aside("repeats", flags_.common.frames)
            .aside("voxels", voxels.value_or(0))
            .number("median_s", times.median, 4)
            .number("min_s", times.least, 4)
            .number("max_s", times.most, 4)
            .number("MB_per_s", rate(sizeof(float)), 0)
            .number("Mvoxels_per_s", rate(1), 0);
        report_.add(record);
    }

    const LoadFlags& flags_;
    cube::Cube cube_;
    Report& report_;
    base::Workers workers_;
};

base::Status make_cube(const LoadFlags& flags, const Scratch& scratch) {
    if (!scratch.made()) {
        return base::error(base::Code::io, "make a cube in " + flags.folder, "no folder can be made there");
    }
    const daemon::Interrupt interrupt;
    deploy::ProgressBar bar("making a cube");
    return samples::write_sample(
        "random", {flags.edge, flags.edge, flags.edge}, 1, scratch.cube(),
        [&](double share) { bar.show(share); }, interrupt.token());
}

base::Status load(const LoadFlags& flags) {
    auto report = Report::open("load", flags.common.json);
    if (!report) {
        return report.error();
    }
    std::optional<Scratch> scratch;
    std::string path = flags.path;
    if (path.empty()) {
        scratch.emplace(flags.folder);
        if (auto made = make_cube(flags, *scratch); !made) {
            return made;
        }
        path = scratch->cube();
    }
    auto cube = cube::open(path);
    if (!cube) {
        return cube.error();
    }
    const auto bytes = static_cast<std::uint64_t>(volume::voxel_count(cube->info.n) * flags.bits / 8);
    if (auto fits = check_memory("load " + path, bytes); !fits) {
        return fits;
    }
    if (auto done = Loading(flags, *std::move(cube), *report).run(); !done) {
        return done;
    }
    report->note("MB are those of the cube as 32-bit floats.");
    report->note(
        "stop: from telling it to stop, at moments spread over its time, until it has. Pictures are those");
    report->note("of a server and two renderers, from their start on.");
    return report->close();
}

}  // namespace

Run add_load(CLI::App& app) {
    auto flags = std::make_shared<LoadFlags>();
    flags->common.frames = 5;
    std::error_code none;
    flags->folder = std::filesystem::temp_directory_path(none).string();
    auto* const cube = app.add_option("cube", flags->path, "a FITS file; else one of random values is made");
    add_size(app, flags->edge);
    app.add_option("--folder", flags->folder, "where the cube is made, for as long as it is needed")
        ->excludes(cube)
        ->capture_default_str();
    app.add_option("--bits", flags->bits, "a voxel is held in")
        ->check(CLI::IsMember({8, 16}))
        ->capture_default_str();
    app.add_option("--repeat", flags->common.frames, "how often each stage is done")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    flags->common.add_threads(app);
    flags->common.add_json(app);
    return [flags] { return status_of("load", load(*flags)); };
}

}  // namespace shearwater::bench
