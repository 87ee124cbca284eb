#include "common/options/serve_options.h"

#include <CLI/CLI.hpp>

namespace shearwater::options {

void ServeOptions::add_to(CLI::App& app) {
    app.add_option("--lod", lod,
                   "for clients that do not say; off: every voxel counts, however small in the picture")
        ->check(CLI::IsMember({"on", "off"}))
        ->capture_default_str();
}

}  // namespace shearwater::options
