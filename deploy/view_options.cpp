#include "deploy/view_options.h"

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>

#include "common/scene/file.h"

namespace shearwater::deploy {

void ViewOptions::add_to(CLI::App& app) {
    const std::string group = "View";
    app.add_option("--azimuth", orbit.azimuth, "degrees about the vertical")
        ->capture_default_str()
        ->group(group);
    app.add_option("--elevation", orbit.elevation, "degrees above the horizontal")
        ->capture_default_str()
        ->group(group);
    app.add_option("--roll", orbit.roll, "degrees that the camera leans to its right")
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
    drawing.add_tf(app, group);
    add_picture_to(app);
    std::vector<std::string> said_by_session = options::DrawingOptions::names();
    for (const char* name :
         {"--azimuth", "--elevation", "--roll", "--distance", "--fov", "--parallel", "--height"}) {
        said_by_session.emplace_back(name);
    }
    options::add_session(app, session, said_by_session, group);
}

void ViewOptions::add_picture_to(CLI::App& app) {
    const std::string group = "View";
    size_option_ = app.add_option("--size", size, "of the picture, WIDTHxHEIGHT pixels")
                       ->capture_default_str()
                       ->group(group);
    quality_option_ =
        app.add_option("--quality", quality, "intermediate pixels per pixel: half, one, one and a half")
            ->check(CLI::IsMember({"draft", "normal", "high"}))
            ->capture_default_str()
            ->group(group);
    drawing.add_ways(app, group);
    crop.add_to(app, group);
    stereo.add_to(app, group);
}

std::vector<std::string> ViewOptions::picture_arguments() const {
    std::vector<std::string> all{"--size", size, "--quality", quality};
    for (const std::vector<std::string>& more :
         {drawing.arguments(), stereo.arguments(), crop.arguments()}) {
        all.insert(all.end(), more.begin(), more.end());
    }
    return all;
}

base::Status ViewOptions::open_session() {
    if (session.empty()) {
        return {};
    }
    const auto scene = scene::read(session);
    if (!scene) {
        return scene.error();
    }
    viewpoint_ = scene->viewpoint;
    drawing.take(*scene);
    if (scene->crop && !crop.box()) {
        crop.take(*scene->crop);
    }
    scaling = scene->scaling;
    if (scene->stereo && !stereo.mode()) {
        stereo.take(*scene->stereo);
    }
    if (size_option_ == nullptr || size_option_->count() == 0) {
        size = std::to_string(scene->size.width) + "x" + std::to_string(scene->size.height);
    }
    if (quality_option_ == nullptr || quality_option_->count() == 0) {
        constexpr std::array names{"draft", "normal", "high"};
        quality = names[static_cast<std::size_t>(scene->quality.value_or(view::Quality::high))];
    }
    return {};
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

view::Quality ViewOptions::quality_value() const {
    return quality == "draft"  ? view::Quality::draft
           : quality == "high" ? view::Quality::high
                               : view::Quality::normal;
}

base::Status ViewOptions::check(const view::Camera& camera) const {
    const auto pixels = image_size();
    if (!pixels) {
        return pixels.error();
    }
    if (auto valid = view::validate(camera, *pixels); !valid) {
        return valid;
    }
    const auto eyes = stereo.settings();
    return eyes ? view::validate(*eyes, camera, *pixels) : base::Status{};
}

base::Result<view::Camera> ViewOptions::camera(const view::Lattice& lattice) const {
    const auto projection = parallel ? view::Projection::parallel : view::Projection::perspective;
    const view::Camera made = viewpoint_ ? view::camera(*viewpoint_, lattice)
                                         : view::camera_on(orbit, lattice, projection, fov, height);
    if (const auto valid = check(made); !valid) {
        return valid.error();
    }
    return made;
}

}  // namespace shearwater::deploy
