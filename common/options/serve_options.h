#pragma once
// The options that say what a server does for clients that do not say: the server's and the one command's.

#include <string>
#include <vector>

#include "common/options/cli_fwd.h"

namespace shearwater::options {

struct ServeOptions {
    std::string lod = "on";

    void add_to(CLI::App& app);

    bool level_of_detail() const { return lod == "on"; }
    std::vector<std::string> arguments() const { return {"--lod", lod}; }
};

}  // namespace shearwater::options
