#pragma once
// The options of a still picture: camera, eyes, size, what is shown of the cube, transfer function, quality,
// classification, level of detail.

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/culling/settings.h"
#include "common/view/camera.h"
#include "common/view/factorisation.h"
#include "common/view/transfer_function.h"
#include "deploy/stereo_options.h"

namespace shearwater::deploy {

// --classify post|pre-integrated.
void add_classify(CLI::App& app, std::string& classify, const std::string& group = "Options");
// --lod on|off.
void add_lod(CLI::App& app, std::string& lod, const std::string& group = "Options");

// --culling-threshold.
void add_culling_threshold(CLI::App& app, double& threshold, const std::string& group = "Options");

// --culling off|pof|opof-linear|opof, --culling-threshold.
struct CullingOptions {
    std::string kind = "off";
    double threshold = culling::Settings::default_threshold;

    void add_to(CLI::App& app, const std::string& group = "Options");
    culling::Settings settings() const;
};

struct ViewOptions {
    view::Orbit orbit;
    bool parallel = false;
    double fov = 30;
    double height = 0;  // parallel; 0: the cube's diagonal
    std::string size = "512x512";
    std::string tf_file;
    std::string quality = "normal";
    std::string classify = "post";
    std::string lod;  // "on" or "off"; empty: as the server has it
    CullingOptions culling;
    StereoOptions stereo;
    std::vector<std::int64_t> crop;  // first and last voxel along each axis; empty: the whole cube

    void add_to(CLI::App& app);

    // Whatever can be wrong before the cube is known.
    base::Result<view::ImageSize> image_size() const;
    base::Result<view::TransferFunction> transfer_function() const;
    view::Quality quality_value() const;
    std::optional<bool> level_of_detail() const {
        return lod.empty() ? std::nullopt : std::optional(lod == "on");
    }
    view::Classify classify_value() const;
    // Without a server.
    view::Sampling sampling() const {
        return view::sampling(quality_value(), level_of_detail().value_or(true), classify_value());
    }
    // The camera for a cube, checked, with the eyes beside it.
    base::Result<view::Camera> camera(const view::Lattice& lattice) const;
    // What of a cube is shown, checked.
    base::Result<std::optional<volume::Box>> crop_of(const view::Lattice& lattice) const;
};

}  // namespace shearwater::deploy
