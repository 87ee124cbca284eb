#include "deploy/view_options.h"

#include <algorithm>
#include <charconv>

#include "common/base/text_file.h"

namespace shearwater::deploy {

void ViewOptions::add_to(CLI::App& app) {
    const std::string group = "View";
    app.add_option("--azimuth", orbit.azimuth, "degrees about the vertical")
        ->capture_default_str()
        ->group(group);
    app.add_option("--elevation", orbit.elevation, "degrees above the horizontal")
        ->capture_default_str()
        ->group(group);
    app.add_option("--distance", orbit.distance, "world units from the cube's middle; else all of it is seen")
        ->check(CLI::PositiveNumber)
        ->group(group);
    app.add_option("--fov", fov, "vertical field of view in degrees")->capture_default_str()->group(group);
    app.add_flag("--parallel", parallel, "parallel projection")->group(group);
    app.add_option("--height", height, "world height of a parallel picture; else the cube's diagonal")
        ->check(CLI::PositiveNumber)
        ->group(group);
    app.add_option("--size", size, "of the picture, WIDTHxHEIGHT pixels")
        ->capture_default_str()
        ->group(group);
    app.add_option("--tf", tf_file, "transfer function, a TOML file")->group(group);
    app.add_option("--quality", quality, "intermediate pixels per pixel: half, one, one and a half")
        ->check(CLI::IsMember({"draft", "normal", "high"}))
        ->capture_default_str()
        ->group(group);
    add_classify(app, classify, group);
    add_lod(app, lod, group);
    culling.add_to(app, group);
    app.add_option("--crop", crop, "show these voxels only: the first and the last along x, y and z, from 0 on")
        ->expected(6)
        ->type_name("X0 X1 Y0 Y1 Z0 Z1")
        ->group(group);
    stereo.add_to(app, group);
}

void CullingOptions::add_to(CLI::App& app, const std::string& group) {
    app.add_option("--culling", kind,
                   "leave out blocks hidden behind others, found by such functions of their opacity")
        ->check(
            CLI::IsMember(std::vector<std::string>(culling::kind_names.begin(), culling::kind_names.end())))
        ->capture_default_str()
        ->group(group);
    add_culling_threshold(app, threshold, group);
}

void add_culling_threshold(CLI::App& app, double& threshold, const std::string& group) {
    app.add_option(
           "--culling-threshold", threshold,
           "opacity that hides what is behind; the default changes no picture by more than a level of 255")
        ->check(CLI::Range(0.5, 0.999999))
        ->group(group);
}

culling::Settings CullingOptions::settings() const {
    const auto found = std::find(culling::kind_names.begin(), culling::kind_names.end(), kind);
    return {static_cast<culling::Kind>(found - culling::kind_names.begin()), threshold};
}

void add_classify(CLI::App& app, std::string& classify, const std::string& group) {
    app.add_option("--classify", classify,
                   "where the transfer function applies: to samples, or to all values between two")
        ->check(CLI::IsMember({"post", "pre-integrated"}))
        ->capture_default_str()
        ->group(group);
}

void add_lod(CLI::App& app, std::string& lod, const std::string& group) {
    app.add_option(
           "--lod", lod,
           "off: every voxel counts, however small in the picture; else on, or as a running server has it")
        ->check(CLI::IsMember({"on", "off"}))
        ->capture_default_str()
        ->group(group);
}

base::Result<view::ImageSize> ViewOptions::image_size() const {
    view::ImageSize parsed;
    const char* const end = size.data() + size.size();
    const auto width = std::from_chars(size.data(), end, parsed.width);
    if (width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x') {
        const auto rows = std::from_chars(width.ptr + 1, end, parsed.height);
        if (rows.ec == std::errc{} && rows.ptr == end) {
            return parsed;
        }
    }
    return base::error(base::Code::invalid_argument, "--size " + size, "is not WIDTHxHEIGHT, like 512x512");
}

base::Result<view::TransferFunction> ViewOptions::transfer_function() const {
    if (tf_file.empty()) {
        return view::default_transfer_function();
    }
    constexpr std::size_t most_bytes = 1 << 20;
    const auto text = base::read_text_file(tf_file, most_bytes);
    if (!text) {
        return text.error();
    }
    return view::transfer_function_from_toml(*text, tf_file);
}

view::Quality ViewOptions::quality_value() const {
    return quality == "draft"  ? view::Quality::draft
           : quality == "high" ? view::Quality::high
                               : view::Quality::normal;
}

view::Classify ViewOptions::classify_value() const {
    return classify == "pre-integrated" ? view::Classify::pre_integrated : view::Classify::post;
}

base::Result<view::Camera> ViewOptions::camera(const view::Lattice& lattice) const {
    const auto pixels = image_size();
    if (!pixels) {
        return pixels.error();
    }
    const view::Camera made = view::camera_on(
        orbit, lattice, parallel ? view::Projection::parallel : view::Projection::perspective, fov, height);
    if (const auto valid = view::validate(made, *pixels); !valid) {
        return valid.error();
    }
    if (const auto eyes = stereo.settings()) {
        if (const auto valid = view::validate(*eyes, made, *pixels); !valid) {
            return valid.error();
        }
    }
    return made;
}

base::Result<std::optional<volume::Box>> ViewOptions::crop_of(const view::Lattice& lattice) const {
    if (crop.size() != 6) {
        return std::optional<volume::Box>();
    }
    const volume::Box box{{crop[0], crop[2], crop[4]}, {crop[1], crop[3], crop[5]}};
    if (const auto valid = view::validate_crop(box, lattice.n); !valid) {
        return valid.error();
    }
    return std::optional(box);
}

}  // namespace shearwater::deploy
