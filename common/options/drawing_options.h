#pragma once
// The options that say how a view is drawn, whoever asks for it: a still, a window, a measurement.

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/culling/settings.h"
#include "common/view/anchored_function.h"
#include "common/view/factorisation.h"

namespace shearwater::options {

struct DrawingOptions {
    std::string tf_file;
    std::string classify = "post";
    std::string lod;  // "on" or "off"; empty: as the server has it
    std::string culling = "off";
    double culling_threshold = culling::Settings::default_threshold;

    // All of them, or one by one.
    void add_to(CLI::App& app, const std::string& group = "Options");
    void add_classify(CLI::App& app, const std::string& group = "Options");
    void add_lod(CLI::App& app, const std::string& group = "Options");
    void add_culling_threshold(CLI::App& app, const std::string& group = "Options");

    // That of the file, or the default one.
    base::Result<view::AnchoredFunction> transfer_function() const;
    view::Classify classification() const;
    std::optional<bool> level_of_detail() const {
        return lod.empty() ? std::nullopt : std::optional(lod == "on");
    }
    culling::Settings culling_settings() const;

    // To hand on to another program.
    std::vector<std::string> arguments() const;
};

// Of a file of TOML.
base::Result<view::AnchoredFunction> read_transfer_function(const std::string& path);

}  // namespace shearwater::options
