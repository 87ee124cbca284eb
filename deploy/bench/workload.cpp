#include "deploy/bench/workload.h"

#include <cmath>
#include <numbers>

#include "common/base/check.h"

namespace shearwater::bench {

namespace {

constexpr double top = 255;
constexpr double noise_ends = 80 / top;

std::vector<view::ColourPin> survey_colours() {
    return {{0, {0.1, 0.2, 0.5}},
            {noise_ends, {0.2, 0.4, 1.0}},
            {150 / top, {1.0, 0.5, 0.1}},
            {1, {1.0, 1.0, 0.8}}};
}

view::TransferFunction ramp_from(double opacity_of_noise) {
    return {.opacity_pins = {view::Ramp{.x0 = noise_ends, .a0 = opacity_of_noise, .x1 = 1, .a1 = 0.3}},
            .colour_pins = survey_colours(),
            .background = {}};
}

}  // namespace

options::CubeOptions Workload::cube(std::int64_t edge) const {
    options::CubeOptions options;
    options.path = "synthetic:" + field + ":" + std::to_string(edge);
    options.range = {0, top};
    return options;
}

const std::vector<std::string>& workload_names() {
    static const std::vector<std::string> names{"W1", "W2", "W3"};
    return names;
}

Workload workload(const std::string& name) {
    if (name == "W1") {
        return {.name = name,
                .field = "random-bytes",
                .tf = {.opacity_pins = {view::Flat{.height = 0.001}},
                       .colour_pins = {{0, {1, 1, 1}}},
                       .background = {}}};
    }
    base::check(name == "W2" || name == "W3", "the parser checked the workload's name");
    return {.name = name, .field = "noise-sources", .tf = ramp_from(name == "W2" ? 0 : 0.05)};
}

deploy::ViewOptions first_view(std::int64_t edge) {
    deploy::ViewOptions view;
    const double distance = Path::edges_away * static_cast<double>(edge);
    view.orbit = {
        .azimuth = Path::first_azimuth, .elevation = Path::elevation, .distance = distance, .target = {}};
    view.fov = Path::fov;
    view.height = 2 * distance * std::tan(Path::fov / 2 * std::numbers::pi / 180);
    return view;
}

}  // namespace shearwater::bench
