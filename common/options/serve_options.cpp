#include "common/options/serve_options.h"

#include <CLI/CLI.hpp>

namespace shearwater::options {

void ServeOptions::add_to(CLI::App& app) {
    app.add_option("--lod", lod,
                   "for clients that do not say; off: every voxel counts, however small in the picture")
        ->check(CLI::IsMember({"on", "off"}))
        ->capture_default_str();
    app.add_option(
           "--culling-by", culling_by,
           "who finds out what is hidden from a view: the server, or its renderers, each for a part of "
           "the picture; auto: these, where some are on other machines and the cube is of 1024^3 or more")
        ->check(CLI::IsMember({"auto", "server", "renderers"}))
        ->capture_default_str();
}

}  // namespace shearwater::options
