// What the last stages of a picture cost: over, the forms pixels travel in, the warp, and run lengths.
//
//   image_bench --benchmark_repetitions=9 --benchmark_report_aggregates_only=true

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "common/image/over.h"
#include "common/image/over_windows.h"
#include "common/image/rle.h"
#include "common/image/silhouette.h"
#include "common/image/warp.h"

namespace shearwater::image {
namespace {

constexpr std::size_t megapixel = std::size_t{1} << 20;

std::vector<RgbaF> random_pixels(std::size_t count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<RgbaF> pixels(count);
    for (RgbaF& pixel : pixels) {
        const float a = unit(random);
        pixel = {a * unit(random), a * unit(random), a * unit(random), a};
    }
    return pixels;
}

std::vector<Rgba16> random_levels(std::size_t count) {
    std::vector<Rgba16> levels(count);
    to_16_bits(random_pixels(count), levels);
    return levels;
}

void count_pixels(benchmark::State& state, std::size_t each) {
    state.SetItemsProcessed(static_cast<std::int64_t>(each) * state.iterations());
}

template <class Pixel>
void over_megapixel(benchmark::State& state) {
    auto front = random_pixels(megapixel);
    const auto back = [] {
        if constexpr (std::is_same_v<Pixel, RgbaF>) {
            return random_pixels(megapixel);
        } else {
            return random_levels(megapixel);
        }
    }();
    for (auto _ : state) {
        over(front, std::span<const Pixel>(back));
        benchmark::ClobberMemory();
    }
    count_pixels(state, megapixel);
}

void to_levels(benchmark::State& state) {
    const auto from = random_pixels(megapixel);
    std::vector<Rgba16> to(megapixel);
    for (auto _ : state) {
        to_16_bits(from, to);
        benchmark::ClobberMemory();
    }
    count_pixels(state, megapixel);
}

void from_levels(benchmark::State& state) {
    const auto from = random_levels(megapixel);
    std::vector<RgbaF> to(megapixel);
    for (auto _ : state) {
        from_16_bits(from, to);
        benchmark::ClobberMemory();
    }
    count_pixels(state, megapixel);
}

// Windows of one face, each 1024 x 1024, the next half a window to the right, as a junction merges them.
void merge_windows(benchmark::State& state) {
    const auto pixels = random_levels(megapixel);
    std::vector<Window> windows;
    for (int n = 0; n < state.range(0); ++n) {
        windows.push_back({.face = 0, .rect = {512 * n, 0, 512 * n + 1024, 1024}, .pixels = {1024, 1024}});
        from_16_bits(pixels, windows.back().pixels.pixels());
    }
    const CodedWindows coded = encode(windows);
    for (auto _ : state) {
        benchmark::DoNotOptimize(merge_coded(coded.windows));
    }
    count_pixels(state, megapixel * windows.size());
}

// Windows of all faces as a renderer of the whole cube would give them. A sparse one is transparent but for a
// disc of about a tenth of it.
std::vector<Window> windows_of(const view::Factorisation& f, bool sparse) {
    const auto last = [&](int axis) { return f.lattice.n[static_cast<std::size_t>(axis)] - 1; };
    const volume::Box all{{0, 0, 0}, {last(0), last(1), last(2)}};
    std::vector<Window> windows;
    for (int n = 0; n < static_cast<int>(f.faces.size()); ++n) {
        const view::Face& face = f.faces[static_cast<std::size_t>(n)];
        const Silhouette silhouette(f, face);
        const Rect rect = window_of(f, face, all);
        windows.push_back({n, rect, {rect.width(), rect.height()}});
        for (int y = 0; y < rect.height(); ++y) {
            for (int x = 0; x < rect.width(); ++x) {
                const double right = (x - 0.45 * rect.width()) / rect.width();
                const double down = (y - 0.55 * rect.height()) / rect.height();
                if (silhouette.pixel_row(y + rect.y0).contains(x + rect.x0) &&
                    (!sparse || std::hypot(right, down) < 0.18)) {
                    const auto wave = static_cast<float>(0.3 + 0.2 * std::sin(0.3 * x) * std::cos(0.2 * y));
                    windows.back().pixels.at(x, y) = {wave, 0.5F * wave, 0.2F, 0.6F};
                }
            }
        }
    }
    return windows;
}

constexpr view::Rgb sky{0.1, 0.1, 0.2};

// size, sparse, threads, azimuth. At azimuth 90 the picture's rows are the columns of the windows.
void warp_view(benchmark::State& state, view::Projection projection, double distance, double fov) {
    const auto side = static_cast<int>(state.range(0));
    const view::Lattice lattice{{256, 256, 256}, {1, 1, 1}};
    const view::ImageSize size{side, side};
    const view::Camera camera =
        view::camera_on({static_cast<double>(state.range(3)), 20, distance}, lattice, projection, fov);
    const view::Factorisation f = view::factorise(camera, size, lattice, {1});
    const std::vector<Window> windows = windows_of(f, state.range(1) != 0);
    base::Workers workers(static_cast<int>(state.range(2)));
    for (auto _ : state) {
        benchmark::DoNotOptimize(warp(f, windows, camera, size, sky, workers));
    }
    count_pixels(state, static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
}

void each_warp(benchmark::internal::Benchmark* program) {
    program->ArgNames({"size", "sparse", "threads", "azimuth"})->Unit(benchmark::kMicrosecond)->UseRealTime();
    for (const int threads : {1, 2}) {
        program->ArgsProduct({{512, 1024}, {0, 1}, {threads}, {30}});
    }
    program->Args({512, 0, 1, 90})->Args({1024, 0, 1, 90});
}

enum Content { runs, noise, galaxy, grain };

// A picture of long runs, of noise, or of both: a disc of noise in an even sky. Or of noise so faint that
// every fifth pixel is like the one before.
std::vector<Rgba8> picture(Content content) {
    std::mt19937 random(2);
    std::vector<Rgba8> pixels(megapixel, Rgba8{26, 26, 51, 255});
    for (std::size_t i = 0; i < megapixel; ++i) {
        const auto x = static_cast<double>(i % 1024), y = static_cast<double>(i / 1024);
        if (content == noise || (content == galaxy && std::hypot(x - 500, y - 500) < 300)) {
            pixels[i] = {static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()), 9, 255};
        } else if (content == runs) {
            pixels[i].g = static_cast<std::uint8_t>(i / 400);
        } else if (content == grain) {
            pixels[i].g = static_cast<std::uint8_t>(random() % 5);
        }
    }
    return pixels;
}

void rle_encode(benchmark::State& state, Content content) {
    const auto pixels = picture(content);
    std::vector<std::byte> bytes(rle_bound(megapixel));
    for (auto _ : state) {
        benchmark::DoNotOptimize(encode_rle(pixels, bytes));
        benchmark::ClobberMemory();
    }
    count_pixels(state, megapixel);
}

void rle_decode(benchmark::State& state, Content content) {
    auto pixels = picture(content);
    std::vector<std::byte> bytes(rle_bound(megapixel));
    bytes.resize(encode_rle(pixels, bytes));
    for (auto _ : state) {
        if (!decode_rle(bytes, pixels)) {
            state.SkipWithError("what was encoded does not decode");
        }
        benchmark::ClobberMemory();
    }
    count_pixels(state, megapixel);
}

BENCHMARK_CAPTURE(warp_view, perspective, view::Projection::perspective, 0, 30)->Apply(each_warp);
BENCHMARK_CAPTURE(warp_view, parallel, view::Projection::parallel, 0, 30)->Apply(each_warp);
BENCHMARK_CAPTURE(warp_view, within, view::Projection::perspective, 60, 100)->Apply(each_warp);
BENCHMARK(over_megapixel<RgbaF>)->Unit(benchmark::kMicrosecond);
BENCHMARK(over_megapixel<Rgba16>)->Unit(benchmark::kMicrosecond);
BENCHMARK(to_levels)->Unit(benchmark::kMicrosecond);
BENCHMARK(from_levels)->Unit(benchmark::kMicrosecond);
BENCHMARK(merge_windows)->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rle_encode, runs, runs)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rle_encode, noise, noise)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rle_encode, galaxy, galaxy)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rle_encode, grain, grain)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rle_decode, runs, runs)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rle_decode, noise, noise)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rle_decode, galaxy, galaxy)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rle_decode, grain, grain)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace shearwater::image
