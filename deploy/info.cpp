#include <CLI/CLI.hpp>
#include <iomanip>
#include <iostream>

#include "common/cube/open.h"
#include "common/options/cube_options.h"
#include "common/volume/statistics.h"
#include "common/wcs/text.h"
#include "deploy/commands.h"
#include "deploy/progress_bar.h"
#include "protocol/daemon/runtime.h"

namespace shearwater::deploy {
namespace {

// From the first voxel to the last of each axis, through the cube's middle.
void print_world(const fits::CubeInfo& info) {
    constexpr const char* names[] = {"x", "y", "z"};
    for (int along = 0; along < 3; ++along) {
        const auto a = static_cast<std::size_t>(along);
        const wcs::Axis& axis = info.world[a];
        if (axis.known()) {
            std::cout << "  " << names[a] << "         " << axis.name << ", "
                      << wcs::plane_text(info.world, along, info.n, 0) << " to "
                      << wcs::plane_text(info.world, along, info.n, static_cast<double>(info.n[a] - 1))
                      << "\n";
        }
    }
}

void print_header(const fits::CubeInfo& info) {
    std::cout << info.path << ", HDU " << info.hdu << "\n";
    std::cout << "  cube      " << info.n[0] << " x " << info.n[1] << " x " << info.n[2] << ", BITPIX "
              << info.bitpix << "\n";
    if (!info.object.empty()) {
        std::cout << "  object    " << info.object << "\n";
    }
    std::cout << "  axes     ";
    for (std::size_t i = 0; i < 3; ++i) {
        std::cout << " " << (info.axis_types[i].empty() ? "-" : info.axis_types[i]) << " ("
                  << info.file_axes[i] << ")";
    }
    std::cout << "\n";
    print_world(info);
    if (info.planes > 1) {
        std::cout << "  plane     " << info.plane << " of " << info.planes << "\n";
    }
    for (const std::string& note : info.notes) {
        std::cout << "  note      " << note << "\n";
    }
}

void print_values(const volume::Histogram& histogram, const fits::CubeInfo& info, double percent) {
    const auto all = histogram.valid() + histogram.blank();
    std::cout << "  unit      " << (info.unit.empty() ? "-" : info.unit) << "\n";
    std::cout << "  blank     " << histogram.blank() << " of " << all << " voxels\n";
    if (histogram.valid() == 0) {
        return;
    }
    const volume::Limits limits = volume::percentile_limits(histogram, percent);
    std::cout << "  range     " << histogram.min() << " to " << histogram.max() << "\n";
    std::cout << "  median    " << histogram.quantile(0.5) << "\n";
    std::cout << "  " << percent << " %    " << limits.lo << " to " << limits.hi << "\n";
}

base::Status info(const options::CubeOptions& options, int threads) {
    fits::OpenOptions open = options.open_options();
    open.world = true;
    auto cube = cube::open(options.path, open);
    if (!cube) {
        return cube.error();
    }
    print_header(cube->info);
    base::Workers workers(threads);
    const auto& n = cube->info.n;
    base::Result<volume::Histogram> histogram = [&] {
        ProgressBar bar("counting");
        return volume::count_values(*cube->source, volume::whole(n), n, workers,
                                    [&](double share) { bar.show(share); });
    }();
    if (!histogram) {
        return histogram.error();
    }
    print_values(*histogram, cube->info, options.percentile);
    return {};
}

}  // namespace

Run add_info(CLI::App& app) {
    auto options = std::make_shared<options::CubeOptions>();
    auto threads = std::make_shared<int>(0);
    app.add_option("cube", options->path, "the FITS file, or synthetic:KIND:SIZE")->required();
    app.add_option("--hdu", options->hdu, "the HDU that holds the cube, from 0; else the first that does")
        ->check(CLI::Range(0, 100000));
    app.add_option("--plane", options->plane, "index along a fourth axis, from 0")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--percentile", options->percentile, "per cent of the voxels kept between the limits")
        ->check(CLI::Range(1.0, 100.0))
        ->capture_default_str();
    app.add_option("--threads", *threads, "threads that compute; 0: one a processor")
        ->check(CLI::Range(0, 1024));
    return [options, threads] {
        const auto done = info(*options, *threads);
        return done ? 0 : daemon::refuse("shearwater info", done.error());
    };
}

}  // namespace shearwater::deploy
