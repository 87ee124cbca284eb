#include "common/options/cube_options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <sstream>

#include "common/base/check.h"

namespace shearwater::options {
namespace {

std::string exact(double value) {
    std::ostringstream text;
    text.precision(17);
    text << value;
    return text.str();
}

}  // namespace

void add_copies(CLI::App& app, int& copies, const std::string& group) {
    app.add_option(
           "--copies", copies,
           "of the voxels in memory; 2: for views along the first axis, which are then as fast as others")
        ->check(CLI::IsMember({1, 2}))
        ->capture_default_str()
        ->group(group);
}

void CubeOptions::add_to(CLI::App& app) {
    const std::string group = "Cube";
    app.add_option("--hdu", hdu, "the file's HDU that holds the cube, from 0; else the first that does")
        ->check(CLI::Range(0, 100000))
        ->group(group);
    app.add_option("--plane", plane, "index along a fourth axis, from 0")
        ->check(CLI::NonNegativeNumber)
        ->group(group);
    app.add_option("--range", range, "the values shown as 0 and 1; else by percentile")
        ->expected(2)
        ->allow_extra_args(false)
        ->group(group);
    app.add_option("--percentile", percentile,
                   "per cent of the voxels kept between the limits, the rest cut equally")
        ->check(CLI::Range(1.0, 100.0))
        ->capture_default_str()
        ->group(group);
    app.add_option("--stretch", stretch, "from value to brightness")
        ->check(CLI::IsMember({"linear", "sqrt", "log", "asinh"}))
        ->capture_default_str()
        ->group(group);
    app.add_option("--bits", bits, "a voxel is held in")
        ->check(CLI::IsMember({8, 16}))
        ->capture_default_str()
        ->group(group);
    add_copies(app, copies, group);
    app.add_option("--spacing", spacing, "world units between voxels along x, y and z")
        ->expected(3)
        ->allow_extra_args(false)
        ->group(group);
}

base::Status CubeOptions::validate() const {
    if (range.size() == 2 && !(std::isfinite(range[0]) && std::isfinite(range[1]) && range[0] < range[1])) {
        return base::error(base::Code::invalid_argument, "--range",
                           "the first value must be below the second");
    }
    for (const double step : spacing) {
        if (!(step > 0) || !std::isfinite(step) || step < 1e-6 || step > 1e6) {
            return base::error(base::Code::invalid_argument, "--spacing",
                               "each must lie between 1e-6 and 1e6");
        }
    }
    return {};
}

volume::Stretch CubeOptions::stretch_value() const {
    const auto value = volume::stretch_named(stretch);
    base::check(value.has_value(), "the parser checked the stretch's name");
    return *value;
}

view::Vec3 CubeOptions::spacing_value() const {
    return spacing.size() == 3 ? view::Vec3{spacing[0], spacing[1], spacing[2]} : view::Vec3{1, 1, 1};
}

std::vector<std::string> CubeOptions::arguments() const {
    std::vector<std::string> words{path};
    const auto add = [&words](const std::string& flag, const std::vector<std::string>& values) {
        words.push_back(flag);
        words.insert(words.end(), values.begin(), values.end());
    };
    if (hdu) add("--hdu", {std::to_string(*hdu)});
    if (plane) add("--plane", {std::to_string(*plane)});
    if (range.size() == 2) add("--range", {exact(range[0]), exact(range[1])});
    add("--percentile", {exact(percentile)});
    add("--stretch", {stretch});
    add("--bits", {std::to_string(bits)});
    add("--copies", {std::to_string(copies)});
    if (spacing.size() == 3) add("--spacing", {exact(spacing[0]), exact(spacing[1]), exact(spacing[2])});
    return words;
}

}  // namespace shearwater::options
