#pragma once
// The options of a still picture: camera, size, quality, and how it is drawn.

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "common/base/result.h"
#include "common/options/drawing_options.h"
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
    std::string session;  // a file that says all of this; size and quality may be given besides

    void add_to(CLI::App& app);
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
    // The camera for a cube, checked.
    base::Result<view::Camera> camera(const view::Lattice& lattice) const;

  private:
    std::optional<view::Viewpoint> viewpoint_;  // the session's
    const CLI::Option* size_option_ = nullptr;
    const CLI::Option* quality_option_ = nullptr;
};

}  // namespace shearwater::deploy
