// bench kernels: the inner loop alone, in the form of each of this processor's vectors, on codes at random.

#include <hwy/highway.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <random>

#include "deploy/bench/options.h"
#include "deploy/bench/report.h"
#include "deploy/bench/subcommands.h"
#include "deploy/bench/timing.h"
#include "renderer/shear/kernel.h"

namespace shearwater::bench {
namespace {

using shear::Slab;

struct KernelsFlags {
    Options common;
    double seconds = 0.1;
};

// Of a tile's pixels, whose samples lie a little less than a voxel apart.
constexpr int rows = 32;
constexpr int cells = 124, cell_rows = 31;
constexpr std::ptrdiff_t voxel_stride = cells + 1;
constexpr std::ptrdiff_t ray_stride = shear::widest_tile + shear::ray_padding;
constexpr int slices = Slab<std::uint8_t>::max_slices;

template <class Code>
class Trial {
  public:
    // Of so many codes one is no value; of 0, none.
    explicit Trial(int blank_of)
        : voxels_(static_cast<std::size_t>(voxel_stride * (cell_rows + 1) * slices) + shear::voxel_padding),
          lengths_(static_cast<std::size_t>(rows * ray_stride)),
          gathered_(4 * lengths_.size()) {
        std::mt19937 random(1);
        std::uniform_int_distribution<int> any(1, sizeof(Code) == 1 ? 255 : 65535);
        for (std::size_t n = 0; n < voxels_.size(); ++n) {
            const bool blank = blank_of > 0 && random() % static_cast<unsigned>(blank_of) == 0;
            voxels_[n] = static_cast<Code>(blank ? 0 : any(random));
        }
        slab_ = {.fast_first = 0,
                 .slow_first = 0,
                 .fast_cells = cells,
                 .slow_cells = cell_rows,
                 .stride = voxel_stride,
                 .ahead = {},
                 .fast_pixel = 0,
                 .slow_pixel = 0,
                 .blanks = blank_of > 0,
                 .between_nodes = false,
                 .faint = true,
                 .count = slices,
                 .slices = {}};
        for (int k = 0; k < slices; ++k) {
            slab_.slices[static_cast<std::size_t>(k)] = {
                .voxels = voxels_.data() + k * voxel_stride * (cell_rows + 1),
                .next = nullptr,
                .fast_offset = 0.1 + 0.01 * k,
                .fast_scale = (cells - 0.5) / shear::widest_tile,
                .slow_offset = 0.2,
                .slow_scale = (cell_rows - 0.5) / rows,
                .pixels = {0, 0, shear::widest_tile, rows},
                .lengths = lengths_.data()};
        }
    }

    // Of all samples, one thread; steep: where a table's extinction is to be interpolated between its nodes.
    Spread time(const shear::OpacityTable& table, bool steep, double seconds) {
        slab_.between_nodes = steep;
        std::ranges::fill(lengths_, table.depth_unit());
        std::ranges::fill(gathered_, 0.0F);
        float* const r = gathered_.data();
        const auto one = static_cast<std::ptrdiff_t>(lengths_.size());
        const shear::Rays rays{r, r + one, r + 2 * one, r + 3 * one, ray_stride};
        return measure(seconds, [&] {
            std::fill_n(rays.a, one, 0.0F);  // so that no ray is ever done
            taken_ = composite_slab(slab_, table, rays);
        });
    }
    std::uint64_t samples() const { return taken_; }

  private:
    std::vector<Code> voxels_;
    std::vector<float> lengths_, gathered_;
    Slab<Code> slab_;
    std::uint64_t taken_ = 0;
};

// All of whose codes have a little opacity.
view::TransferFunction faint(bool one_hue) {
    return {.opacity_pins = {view::Flat{0.001}},
            .colour_pins = one_hue ? std::vector<view::ColourPin>{{0, {1, 1, 1}}}
                                   : std::vector<view::ColourPin>{{0, {1, 0, 0.5}}, {1, {0, 1, 0.25}}},
            .background = {}};
}

class Kernels {
  public:
    Kernels(const KernelsFlags& flags, Report& report) : flags_(flags), report_(report) {}

    template <class Code>
    void time(const std::string& simd, const char* blanks, int blank_of) {
        Trial<Code> trial(blank_of);
        struct Tables {
            const char* name;
            bool one_hue, steep;
        };
        for (const auto& [name, one_hue, steep] :
             {Tables{"one hue", true, false}, Tables{"many", false, false},
              Tables{"many, steep", false, true}}) {
            const shear::OpacityTable table(faint(one_hue), std::numeric_limits<Code>::max());
            const Spread times = trial.time(table, steep, flags_.seconds);
            Record record;
            const auto samples = static_cast<double>(trial.samples());
            record.text("simd", simd, 8)
                .count("bits", 8 * sizeof(Code))
                .text("blanks", blanks, 9)
                .text("hues", name, 11)
                .count("samples", trial.samples())
                .number("median_ms", times.median * 1e3, 3)
                .number("min_ms", times.least * 1e3, 3)
                .number("Msamples_per_s", samples / times.median / 1e6, 0);
            report_.add(record);
        }
    }

  private:
    const KernelsFlags& flags_;
    Report& report_;
};

base::Status kernels(const KernelsFlags& flags) {
    auto report = Report::open("kernels", flags.common.json);
    if (!report) {
        return report.error();
    }
    Kernels timed(flags, *report);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        const std::string simd = hwy::TargetName(target);
        for (const auto& [blanks, blank_of] : {std::pair("none", 0), std::pair("one of 64", 64)}) {
            timed.time<std::uint8_t>(simd, blanks, blank_of);
            timed.time<std::uint16_t>(simd, blanks, blank_of);
        }
    }
    hwy::SetSupportedTargetsForTest(0);
    return report->close();
}

}  // namespace

Run add_kernels(CLI::App& app) {
    auto flags = std::make_shared<KernelsFlags>();
    app.add_option("--seconds", flags->seconds, "that each is done for")
        ->check(CLI::Range(0.0, 3600.0))
        ->capture_default_str();
    flags->common.add_json(app);
    return [flags] { return status_of("kernels", kernels(*flags)); };
}

}  // namespace shearwater::bench
