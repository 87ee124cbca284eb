#include "deploy/view_options.h"

#include <charconv>

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
    app.add_option("--quality", quality, "intermediate pixels per pixel: half, one, one and a half")
        ->check(CLI::IsMember({"draft", "normal", "high"}))
        ->capture_default_str()
        ->group(group);
    drawing.add_to(app, group);
    app.add_option("--crop", crop, "show these voxels only: the first and the last along x, y and z, from 0 on")
        ->expected(6)
        ->type_name("X0 X1 Y0 Y1 Z0 Z1")
        ->group(group);
    stereo.add_to(app, group);
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
