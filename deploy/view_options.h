#pragma once
// The options of a still picture: camera, eyes, size, what is shown of the cube, quality, and how it is
// drawn.

#include <optional>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/options/cli_fwd.h"
#include "common/options/crop_option.h"
#include "common/options/drawing_options.h"
#include "common/options/stereo_options.h"
#include "common/view/viewpoint.h"

namespace shearwater::deploy {

struct ViewOptions {
    view::Orbit orbit;
    bool parallel = false;
    double fov = 30;
    double height = 0;  // parallel; 0: the cube's diagonal
    std::string size = "512x512";
    std::string quality = "normal";
    options::DrawingOptions drawing;
    options::StereoOptions stereo;
    options::CropOption crop;
    std::optional<volume::Scaling> scaling;  // of the cube's values, by the session; else as it is loaded
    std::string session;  // a file that says the rest; size and quality may be given besides

    // All of them; or those that do not say from where, nor by which transfer function.
    void add_to(CLI::App& app);
    void add_picture_to(CLI::App& app);
    // The latter, as they are given.
    std::vector<std::string> picture_arguments() const;
    // Takes over what the session says, if there is one. To be called once the options are read.
    base::Status open_session();

    // Whatever can be wrong before the cube is known.
    base::Result<view::ImageSize> image_size() const;
    view::Quality quality_value() const;
    // Without a server.
    view::Sampling sampling() const {
        return view::sampling(quality_value(), drawing.level_of_detail().value_or(true),
                              drawing.classification());
    }
    // Whether a picture can be taken so by a camera, and by the eyes beside it.
    base::Status check(const view::Camera& camera) const;
    // The camera for a cube, checked.
    base::Result<view::Camera> camera(const view::Lattice& lattice) const;

  private:
    std::optional<view::Viewpoint> viewpoint_;  // the session's
    const CLI::Option* size_option_ = nullptr;
    const CLI::Option* quality_option_ = nullptr;
};

}  // namespace shearwater::deploy
