#pragma once
// What is seen and how it is drawn, whatever the cube: what a window keeps in a file, and a still is drawn
// from.

#include <optional>
#include <string>

#include "common/culling/settings.h"
#include "common/image/stereo_modes.h"
#include "common/view/factorisation.h"
#include "common/view/stereo.h"
#include "common/view/transfer_function.h"
#include "common/view/viewpoint.h"
#include "common/volume/mapping.h"

namespace shearwater::scene {

// Two pictures, and how they are shown as one.
struct Pair {
    view::StereoSettings eyes;
    image::StereoMode mode = image::StereoMode::side_by_side;
    bool operator==(const Pair&) const = default;
};

struct Scene {
    std::string cube;  // the name of that it was kept from; empty: unknown
    view::Viewpoint viewpoint;
    view::ImageSize size;
    view::TransferFunction tf = view::default_transfer_function();
    std::optional<bool> level_of_detail;  // else as the server has it
    view::Classify classify = view::Classify::post;
    culling::Settings culling;
    std::optional<view::Quality> quality;  // else by the frame rate while the view moves, and high at rest
    double target_rate = 20;               // frames a second
    std::optional<volume::Box> crop;       // of the cube that it was kept from
    std::optional<Pair> stereo;
    std::optional<volume::Scaling> scaling;  // of the cube's values; else as whoever loads it has it

    bool operator==(const Scene&) const = default;

    static constexpr double min_rate = 1, max_rate = 60;
};

// Whether all of it is within range.
base::Status validate(const Scene& scene);

// A TOML document, one of version 1. Its last line is needed, so that what was cut short is not taken.
std::string to_toml(const Scene& scene);
// An unknown key, a missing one, or a value out of range is refused by name and line. `source` is what an
// error calls the document.
base::Result<Scene> scene_from_toml(std::string_view text, std::string_view source);

}  // namespace shearwater::scene
