#pragma once
// What a benchmark in one process draws: workloads, or a FITS file.

#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/options/cli_fwd.h"
#include "common/options/cube_options.h"
#include "common/view/transfer_function.h"
#include "deploy/bench/in_process.h"

namespace shearwater::bench {

struct Case {
    std::string name;
    options::CubeOptions cube;
    view::TransferFunction tf;
};

// Its cube, with a bar on the terminal.
base::Result<InProcess> load(const Case& drawn, int threads);

struct CaseOptions {
    options::CubeOptions cube{};
    std::vector<std::string> workloads;  // if there is no file
    std::int64_t edge = 256;
    std::string tf_file{};

    void add_to(CLI::App& app);
    base::Result<std::vector<Case>> cases() const;
};

}  // namespace shearwater::bench
