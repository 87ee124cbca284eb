#pragma once
// The options that say how a view is drawn, whoever asks for it: a still, a window, a measurement.

#include <optional>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/culling/settings.h"
#include "common/options/cli_fwd.h"
#include "common/scene/scene.h"
#include "common/view/anchored_function.h"
#include "common/view/factorisation.h"

namespace shearwater::options {

struct DrawingOptions {
    std::string tf_file;
    std::string classify = "post";
    std::string lod;  // "on" or "off"; empty: as the server has it
    std::string culling = "off";
    double culling_threshold = culling::Settings::default_threshold;
    std::optional<view::TransferFunction> taken_tf;  // a session's

    // All of them; or the transfer function, and the ways it is drawn; or one by one.
    void add_to(CLI::App& app, const std::string& group = "Options");
    void add_tf(CLI::App& app, const std::string& group = "Options");
    void add_ways(CLI::App& app, const std::string& group = "Options");
    void add_classify(CLI::App& app, const std::string& group = "Options");
    void add_lod(CLI::App& app, const std::string& group = "Options");
    void add_culling_threshold(CLI::App& app, const std::string& group = "Options");

    // That of the session or the file, or the default one.
    base::Result<view::AnchoredFunction> transfer_function() const;
    view::Classify classification() const;
    std::optional<bool> level_of_detail() const {
        return lod.empty() ? std::nullopt : std::optional(lod == "on");
    }
    culling::Settings culling_settings() const;

    // What a session says of it, in place of all of them.
    void take(const scene::Scene& scene);
    static std::vector<std::string> names();

    // To hand on to another program.
    std::vector<std::string> arguments() const;
};

// --session FILE, a session or a picture with one. It says all of what the options named so do, which are
// declared already: none of them goes with it.
void add_session(CLI::App& app, std::string& path, const std::vector<std::string>& instead_of,
                 const std::string& group = "Options");

// Of a file of TOML.
base::Result<view::AnchoredFunction> read_transfer_function(const std::string& path);

}  // namespace shearwater::options
