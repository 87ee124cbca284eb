// What the ways to classify and the qualities give for their time: pictures beside those of the independent
// ray caster in fine steps, and how long each takes.
//
//     quality_bench [--bits 8|16] CUBE.fits ...
//
// draws each cube, and one of concentric shells, under a smooth ramp and under a sharp hat, 400 x 400 pixels.

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/stopwatch.h"
#include "common/fits/cube.h"
#include "common/volume/statistics.h"
#include "tests/support/reference_raycaster.h"
#include "tests/support/reference_views.h"

namespace {

using namespace shearwater;
using test::FloatCube;
using test::Scene;

// Waves about a point outside the cube, twelve voxels apart or so.
Scene shells() {
    return {.cube = FloatCube({96, 96, 96}, [](double x, double y, double z) {
                return static_cast<float>(0.5 + 0.5 * std::sin(std::hypot(x + 7, y - 21, z + 13) / 2));
            })};
}

base::Result<Scene> open(const std::string& path) {
    auto file = fits::Cube::open(path);
    if (!file) {
        return file.error();
    }
    Scene scene{.cube = FloatCube(file->info().n)};
    if (const auto read = file->read(volume::whole(scene.cube.n()), scene.cube.values()); !read) {
        return read.error();
    }
    volume::Histogram histogram;
    histogram.add(scene.cube.values());
    const volume::Limits limits = volume::percentile_limits(histogram, 99.5);
    scene.mapping.lo = limits.lo;
    scene.mapping.hi = limits.hi;
    return scene;
}

struct Named {
    std::string name;
    view::TransferFunction tf;
};

std::vector<Named> transfer_functions() {
    view::TransferFunction hat = test::ramp_to(0);
    hat.opacity_pins = {view::Hat{.centre = 0.45, .top = 0.02, .base = 0.02, .height = 0.9}};
    return {{"ramp", test::ramp_to(0.15)}, {"sharp hat", hat}};
}

// The least of some times.
template <class Work>
double seconds_of(const Work& work) {
    constexpr int times = 7;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < times; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        work();
        least = std::min(least, base::seconds_since(begin));
    }
    return least;
}

void measure(const std::string& name, Scene& scene) {
    constexpr view::ImageSize size{400, 400};
    constexpr double fine = 1.0 / 32;
    base::Workers all;
    base::Workers one(1);
    const auto volume = test::bricks_of(scene.cube, all, scene.mapping);
    const view::Lattice lattice = scene.lattice();
    const view::Camera camera = view::camera_on({30, 20}, lattice, view::Projection::perspective);
    for (const auto& [function, tf] : transfer_functions()) {
        const auto truth = test::in_8_bits(
            test::cast_rays(scene.cube, scene.spacing, scene.mapping, tf, camera, size, all, fine));
        for (const auto& [quality, quality_name] :
             {std::pair{view::Quality::normal, "normal"}, {view::Quality::high, "high"}}) {
            for (const auto& [classify, way] : {std::pair{view::Classify::post, "post"},
                                                {view::Classify::pre_integrated, "pre-integrated"}}) {
                const view::Sampling sampling = view::sampling(quality, false, classify);
                const auto picture =
                    test::in_8_bits(test::picture_of(volume, lattice, tf, camera, size, all, sampling));
                const auto factorisation = view::factorise(camera, size, lattice, sampling);
                const auto classification = shear::classify(volume, tf, classify, one);
                const double edit = seconds_of([&] { shear::classify(volume, tf, classify, one); });
                const double render =
                    seconds_of([&] { shear::render(volume, classification, factorisation, one); });
                fmt::print("| {} | {} | {} | {} | {:.1f} | {:.1f} | {:.2f} |\n", name, function, quality_name,
                           way, test::psnr(picture, truth), 1e3 * render, 1e3 * edit);
            }
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> paths(argv + 1, argv + argc);
    int bits = 8;
    if (paths.size() >= 2 && paths[0] == "--bits") {
        bits = paths[1] == "16" ? 16 : 8;
        paths.erase(paths.begin(), paths.begin() + 2);
    }
    fmt::print("| cube, {} bits | function | quality | classified | dB | render ms | classify ms |\n", bits);
    fmt::print("| --- | --- | --- | --- | --- | --- | --- |\n");
    Scene made = shells();
    made.mapping.bits = bits;
    measure("shells", made);
    for (const std::string& path : paths) {
        auto scene = open(path);
        if (!scene) {
            fmt::print(stderr, "quality_bench: {}\n", scene.error().message());
            return 2;
        }
        scene->mapping.bits = bits;
        measure(path.substr(path.rfind('/') + 1), *scene);
    }
    return 0;
}
