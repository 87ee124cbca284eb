#pragma once
// The options that say which cube to show and how its values become codes: the server's and the
// one command's.

#include <optional>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/fits/cube.h"
#include "common/options/cli_fwd.h"
#include "common/view/geometry.h"
#include "common/volume/mapping.h"

namespace shearwater::options {

// --copies, which says how many of the codes to keep in memory.
void add_copies(CLI::App& app, int& copies, const std::string& group = "Options");

struct CubeOptions {
    std::string path;
    std::optional<int> hdu;
    std::optional<std::int64_t> plane;
    std::vector<double> range;  // lo hi, or empty
    double percentile = 99.5;
    std::string stretch = "linear";
    int bits = 8;
    int copies = 1;               // of the codes, in memory: 1 or 2
    std::vector<double> spacing;  // x y z, or empty: 1 1 1

    // All but the path, which each command takes in its own way.
    void add_to(CLI::App& app);

    // What no option parser sees: a range upside down, spacings not above 0.
    base::Status validate() const;
    volume::Stretch stretch_value() const;
    view::Vec3 spacing_value() const;
    fits::OpenOptions open_options() const { return {.hdu = hdu, .plane = plane}; }

    // The same as arguments for another of our programs, path first.
    std::vector<std::string> arguments() const;
};

}  // namespace shearwater::options
