#pragma once
// The subcommands of `shearwater`: each adds its options to the command line and, when it was the one
// typed, runs and gives the exit status.

#include <functional>

#include "common/options/cli_fwd.h"

namespace shearwater::deploy {

using Run = std::function<int()>;

Run add_view(CLI::App& app);
Run add_serve(CLI::App& app);
Run add_snapshot(CLI::App& app);
Run add_movie(CLI::App& app);
Run add_info(CLI::App& app);
Run add_sample(CLI::App& app);
Run add_bench(CLI::App& app);  // in deploy/bench

}  // namespace shearwater::deploy
