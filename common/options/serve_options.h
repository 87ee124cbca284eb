#pragma once
// The options that say how a server serves its clients: the server's and the one command's.

#include <string>
#include <vector>

#include "common/options/cli_fwd.h"

namespace shearwater::options {

struct ServeOptions {
    std::string lod = "on";  // for clients that do not say
    std::string culling_by = "auto";

    void add_to(CLI::App& app);

    bool level_of_detail() const { return lod == "on"; }
    std::vector<std::string> arguments() const { return {"--lod", lod, "--culling-by", culling_by}; }
};

}  // namespace shearwater::options
