#pragma once
// The benchmarks, each a subcommand of `shearwater bench`.

#include "deploy/commands.h"

namespace shearwater::bench {

using deploy::Run;

Run add_kernels(CLI::App& app);
Run add_frame(CLI::App& app);
Run add_trees(CLI::App& app);
Run add_images(CLI::App& app);
Run add_stages(CLI::App& app);
Run add_load(CLI::App& app);
Run add_codecs(CLI::App& app);
Run add_large(CLI::App& app);
Run add_culling(CLI::App& app);

}  // namespace shearwater::bench
