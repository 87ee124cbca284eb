#include "common/options/drawing_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "common/base/text_file.h"

namespace shearwater::options {

void DrawingOptions::add_to(CLI::App& app, const std::string& group) {
    add_tf(app, group);
    add_ways(app, group);
}

void DrawingOptions::add_tf(CLI::App& app, const std::string& group) {
    app.add_option("--tf", tf_file, "transfer function, a TOML file; its [scale] says by what it is placed")
        ->group(group);
}

void DrawingOptions::add_ways(CLI::App& app, const std::string& group) {
    add_classify(app, group);
    add_lod(app, group);
    app.add_option("--culling", culling,
                   "leave out blocks hidden behind others, found by such functions of their opacity")
        ->check(
            CLI::IsMember(std::vector<std::string>(culling::kind_names.begin(), culling::kind_names.end())))
        ->capture_default_str()
        ->group(group);
    add_culling_threshold(app, group);
}

void DrawingOptions::add_classify(CLI::App& app, const std::string& group) {
    app.add_option("--classify", classify,
                   "where the transfer function applies: to samples, or to all values between two")
        ->check(CLI::IsMember({"post", "pre-integrated"}))
        ->capture_default_str()
        ->group(group);
}

void DrawingOptions::add_lod(CLI::App& app, const std::string& group) {
    app.add_option(
           "--lod", lod,
           "off: every voxel counts, however small in the picture; else on, or as a running server has it")
        ->check(CLI::IsMember({"on", "off"}))
        ->capture_default_str()
        ->group(group);
}

void DrawingOptions::add_culling_threshold(CLI::App& app, const std::string& group) {
    app.add_option(
           "--culling-threshold", culling_threshold,
           "opacity that hides what is behind; the default changes no picture by more than a level of 255")
        ->check(CLI::Range(0.5, 0.999999))
        ->group(group);
}

base::Result<view::AnchoredFunction> DrawingOptions::transfer_function() const {
    if (taken_tf) {
        return view::AnchoredFunction{.tf = *taken_tf};
    }
    return tf_file.empty() ? view::AnchoredFunction{.tf = view::default_transfer_function()}
                           : read_transfer_function(tf_file);
}

view::Classify DrawingOptions::classification() const {
    return classify == "pre-integrated" ? view::Classify::pre_integrated : view::Classify::post;
}

culling::Settings DrawingOptions::culling_settings() const {
    const auto found = std::find(culling::kind_names.begin(), culling::kind_names.end(), culling);
    return {static_cast<culling::Kind>(found - culling::kind_names.begin()), culling_threshold};
}

void DrawingOptions::take(const scene::Scene& scene) {
    taken_tf = scene.tf;
    classify = scene.classify == view::Classify::pre_integrated ? "pre-integrated" : "post";
    lod = !scene.level_of_detail ? "" : *scene.level_of_detail ? "on" : "off";
    culling = culling::kind_names[static_cast<std::size_t>(scene.culling.kind)];
    culling_threshold = scene.culling.threshold;
}

std::vector<std::string> DrawingOptions::names() {
    return {"--tf", "--classify", "--lod", "--culling", "--culling-threshold"};
}

void add_session(CLI::App& app, std::string& path, const std::vector<std::string>& instead_of,
                 const std::string& group) {
    CLI::Option* const session =
        app.add_option("--session", path, "the view that a window has saved: its file, or a picture of it")
            ->group(group);
    for (const std::string& name : instead_of) {
        session->excludes(app.get_option(name));
    }
}

std::vector<std::string> DrawingOptions::arguments() const {
    std::vector<std::string> words{"--classify",          classify,
                                   "--culling",           culling,
                                   "--culling-threshold", std::to_string(culling_threshold)};
    if (!lod.empty()) {
        words.insert(words.end(), {"--lod", lod});
    }
    if (!tf_file.empty()) {
        words.insert(words.end(), {"--tf", tf_file});
    }
    return words;
}

base::Result<view::AnchoredFunction> read_transfer_function(const std::string& path) {
    constexpr std::size_t most_bytes = 1 << 20;
    const auto text = base::read_text_file(path, most_bytes);
    if (!text) {
        return text.error();
    }
    return view::transfer_function_from_toml(*text, path);
}

}  // namespace shearwater::options
