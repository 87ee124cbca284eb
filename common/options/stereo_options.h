#pragma once
// The options of a pair of pictures: how the eyes stand, and how their pictures are shown.

#include <optional>
#include <string>
#include <vector>

#include "common/options/cli_fwd.h"
#include "common/scene/scene.h"
#include "common/view/stereo.h"

namespace shearwater::options {

// --stereo MODE, or off, --eye-separation, --convergence and --swap-eyes.
struct StereoOptions {
    std::string shown = "off";
    view::StereoSettings eyes;

    void add_to(CLI::App& app, const std::string& group = "Options");

    std::vector<std::string> arguments() const;  // as they are given
    void take(const scene::Pair& pair);

    // Nothing where one picture is wanted.
    std::optional<image::StereoMode> mode() const { return image::stereo_mode(shown); }
    std::optional<view::StereoSettings> settings() const {
        return mode() ? std::optional(eyes) : std::nullopt;
    }
    std::optional<scene::Pair> pair() const {
        return mode() ? std::optional(scene::Pair{eyes, *mode()}) : std::nullopt;
    }
};

}  // namespace shearwater::options
