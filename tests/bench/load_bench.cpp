// How fast voxels come from a file in the page cache to where bricks are made: reading, codes, counts.
// Bytes are those of the floats that come out.

#include <benchmark/benchmark.h>

#include <array>
#include <atomic>
#include <fstream>
#include <map>
#include <random>

#include "common/base/check.h"
#include "common/fits/cube.h"
#include "common/volume/quantiser.h"
#include "common/volume/statistics.h"
#include "tests/support/fits_fixture.h"

namespace shearwater {
namespace {

using volume::Box;
using volume::Index3;

constexpr Index3 n{512, 512, 128};
constexpr std::size_t voxels = std::size_t{512} * 512 * 128;

// Noise with a source in it, as most of a cube is.
std::vector<float> sky(std::size_t count) {
    std::mt19937 random(5);
    std::normal_distribution<float> noise(0.0F, 1e-3F);
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = noise(random) + (i % 4096 < 400 ? 1e-2F : 0.0F);
    }
    return values;
}

// Files of one value type each, made once. Bytes at random are values of any integer type; those of
// floats have exponents of their own choosing.
class Files {
  public:
    std::string path(int bitpix) {
        const auto [known, is_new] = paths_.try_emplace(bitpix, folder_.path(std::to_string(bitpix)));
        if (is_new) {
            write(known->second, bitpix);
        }
        return known->second;
    }

  private:
    static void write(const std::string& path, int bitpix) {
        std::vector<std::string> cards = {"SIMPLE  =                    T", support::card("BITPIX", bitpix),
                                          support::card("NAXIS", 3)};
        for (int axis = 0; axis < 3; ++axis) {
            cards.push_back(support::card("NAXIS" + std::to_string(axis + 1), n[axis]));
        }
        if (bitpix > 0) {
            cards.push_back("BSCALE  =                 0.25");
            cards.push_back(support::card("BLANK", 7));
        }
        std::ofstream file(path, std::ios::binary);
        file << support::header_of(cards);
        const std::size_t bytes = voxels * static_cast<std::size_t>(std::abs(bitpix)) / 8;
        std::vector<std::uint64_t> block(2880 / 8);
        std::mt19937_64 random(7);
        for (std::size_t done = 0; done < bytes; done += 2880) {
            for (std::uint64_t& word : block) {
                const std::uint64_t bits = random();
                word = bitpix == -32   ? (bits & 0xffff7f00ffff7f00U) | 0x0000003a0000003aU
                       : bitpix == -64 ? (bits & 0xffffffffffff0000U) | 0x00000000000e503fU
                                       : bits;
            }
            file.write(reinterpret_cast<const char*>(block.data()), 2880);
        }
        base::check(file.good(), "the file is written");
    }

    support::TemporaryFolder folder_;
    std::map<int, std::string> paths_;
};

Files& files() {
    static Files all;
    return all;
}

fits::Cube cube_of(int bitpix) {
    auto cube = fits::Cube::open(files().path(bitpix));
    base::check(cube.has_value(), "the file can be opened");
    return std::move(*cube);
}

// Reads one box after the other as a loader does, through the cube.
void read_boxes(benchmark::State& state, const Index3& planes) {
    fits::Cube cube = cube_of(static_cast<int>(state.range(0)));
    std::vector<float> values(static_cast<std::size_t>(planes[0] * planes[1] * planes[2]));
    Index3 at{};
    for (auto _ : state) {
        const Box box{at, {at[0] + planes[0] - 1, at[1] + planes[1] - 1, at[2] + planes[2] - 1}};
        base::check(cube.read(box, values).has_value(), "the box can be read");
        for (int axis = 0; axis < 3; ++axis) {
            at[axis] += planes[axis];
            if (at[axis] + planes[axis] <= n[axis]) {
                break;
            }
            at[axis] = 0;
        }
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(values.size() * sizeof(float)));
}

void read_planes(benchmark::State& state) {
    read_boxes(state, {512, 512, 16});
}
void read_rows(benchmark::State& state) {
    read_boxes(state, {512, 33, 33});
}
void read_short_rows(benchmark::State& state) {
    read_boxes(state, {65, 65, 65});
}
BENCHMARK(read_planes)->Arg(-32)->Arg(16)->Arg(8)->Arg(-64)->Arg(32);
BENCHMARK(read_rows)->Arg(-32)->Arg(16)->Arg(8)->Arg(-64);
BENCHMARK(read_short_rows)->Arg(-32)->Arg(16)->Arg(8)->Arg(-64);

template <class Code>
void codes(benchmark::State& state) {
    const volume::Quantiser quantiser({.lo = -2e-3,
                                       .hi = 1.3e-2,
                                       .stretch = static_cast<volume::Stretch>(state.range(0)),
                                       .bits = 8 * static_cast<int>(sizeof(Code))});
    const std::vector<float> values = sky(1 << 18);
    std::vector<Code> out(values.size());
    for (auto _ : state) {
        quantiser.codes(values, out);
        benchmark::DoNotOptimize(out.data());
    }
    state.SetLabel(std::string(name(quantiser.mapping().stretch)));
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(values.size() * sizeof(float)));
}
BENCHMARK(codes<std::uint8_t>)->DenseRange(0, 3);
BENCHMARK(codes<std::uint16_t>)->DenseRange(0, 3);

// From the file to codes, as much at a time as stays in the caches.
void read_to_codes(benchmark::State& state) {
    fits::Cube cube = cube_of(static_cast<int>(state.range(0)));
    base::Workers workers(static_cast<int>(state.range(1)));
    const volume::Quantiser quantiser({.lo = 0, .hi = 1e-3});
    constexpr std::size_t plane = voxels / std::size_t{n[2]};
    std::vector<std::uint8_t> out(voxels);
    for (auto _ : state) {
        std::atomic<std::int64_t> next{0};
        workers.for_each(workers.threads(), [&](std::int64_t) {
            std::vector<float> values(plane);
            for (std::int64_t z = next++; z < n[2]; z = next++) {
                const Box box{{0, 0, z}, {n[0] - 1, n[1] - 1, z}};
                base::check(cube.read(box, values).has_value(), "the plane can be read");
                quantiser.codes(values, std::span(out).subspan(static_cast<std::size_t>(z) * plane, plane));
            }
        });
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(voxels * sizeof(float)));
}
BENCHMARK(read_to_codes)
    ->ArgsProduct({{-32, 16}, {1, 2}})
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

void histogram_add(benchmark::State& state) {
    std::vector<float> values = sky(1 << 18);
    if (state.range(0) != 0) {
        std::fill(values.begin(), values.end(), 0.0F);
    }
    volume::Histogram histogram;
    for (auto _ : state) {
        histogram.add(values);
    }
    state.SetLabel(state.range(0) != 0 ? "constant" : "noise");
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(values.size() * sizeof(float)));
}
BENCHMARK(histogram_add)->Arg(0)->Arg(1);

void count_values(benchmark::State& state) {
    fits::Cube cube = cube_of(static_cast<int>(state.range(0)));
    base::Workers workers(static_cast<int>(state.range(1)));
    for (auto _ : state) {
        base::check(volume::count_values(cube, volume::whole(n), n, workers).has_value(), "it is counted");
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(voxels * sizeof(float)));
}
BENCHMARK(count_values)->ArgsProduct({{-32, 16}, {1, 2}})->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace shearwater

BENCHMARK_MAIN();
