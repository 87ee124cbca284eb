#include "common/options/drawing_options.h"

#include <algorithm>

#include "common/base/text_file.h"

namespace shearwater::options {

void DrawingOptions::add_to(CLI::App& app, const std::string& group) {
    app.add_option("--tf", tf_file, "transfer function, a TOML file; its [scale] says by what it is placed")
        ->group(group);
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
