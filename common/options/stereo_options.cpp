#include "common/options/stereo_options.h"

#include <fmt/core.h>
#include <CLI/CLI.hpp>

namespace shearwater::options {

void StereoOptions::add_to(CLI::App& app, const std::string& group) {
    std::vector<std::string> names{"off"};
    names.insert(names.end(), image::stereo_mode_names.begin(), image::stereo_mode_names.end());
    CLI::Option* const stereo =
        app.add_option("--stereo", shown, "two pictures, for two eyes, and how they are shown as one")
            ->check(CLI::IsMember(names))
            ->capture_default_str()
            ->group(group);
    app.add_option("--eye-separation", eyes.separation,
                   "world units between the eyes; else a thirtieth of the convergence")
        ->check(CLI::PositiveNumber)
        ->needs(stereo)
        ->group(group);
    app.add_option("--convergence", eyes.convergence,
                   "how far away what lies at the picture's depth is, world units; else the target")
        ->check(CLI::PositiveNumber)
        ->needs(stereo)
        ->group(group);
    app.add_flag("--swap-eyes", eyes.swap, "show each eye what is the other's")->needs(stereo)->group(group);
}

void StereoOptions::take(const scene::Pair& pair) {
    shown = image::stereo_mode_names[static_cast<std::size_t>(pair.mode)];
    eyes = pair.eyes;
}

std::vector<std::string> StereoOptions::arguments() const {
    if (!mode()) {
        return {};
    }
    std::vector<std::string> all{"--stereo", shown};
    if (eyes.separation > 0) {
        all.insert(all.end(), {"--eye-separation", fmt::format("{}", eyes.separation)});
    }
    if (eyes.convergence > 0) {
        all.insert(all.end(), {"--convergence", fmt::format("{}", eyes.convergence)});
    }
    if (eyes.swap) {
        all.emplace_back("--swap-eyes");
    }
    return all;
}

}  // namespace shearwater::options
