#include <CLI/CLI.hpp>
#include <iostream>
#include <stop_token>

#include "deploy/commands.h"
#include "deploy/progress_bar.h"
#include "deploy/samples/sample.h"
#include "protocol/daemon/interrupt.h"
#include "protocol/daemon/runtime.h"

namespace shearwater::deploy {
namespace {

struct SampleFlags {
    std::string name;
    std::string output;
    std::vector<std::int64_t> size{128, 128, 128};
    std::uint64_t seed = 1;
    int bitpix = -32;
};

base::Status sample(const SampleFlags& flags) {
    const volume::Index3 n{flags.size[0], flags.size[1], flags.size[2]};
    const daemon::Interrupt interrupt;
    ProgressBar bar("making " + flags.name);
    return samples::write_sample(
        flags.name, n, flags.seed, flags.output, [&](double share) { bar.show(share); }, interrupt.token(),
        flags.bitpix);
}

}  // namespace

Run add_sample(CLI::App& app) {
    auto flags = std::make_shared<SampleFlags>();
    std::string kinds;
    for (const samples::SampleKind& kind : samples::kinds()) {
        kinds += "\n  " + std::string(kind.name) + ": " + std::string(kind.description);
    }
    app.footer("Samples:" + kinds);
    app.add_option("name", flags->name, "which sample")->required();
    app.add_option("-o,--output", flags->output, "the FITS file to write")->required();
    app.add_option("--size", flags->size, "voxels along x, y and z")
        ->expected(3)
        ->allow_extra_args(false)
        ->capture_default_str();
    app.add_option("--seed", flags->seed, "of its randomness")->capture_default_str();
    app.add_option("--bitpix", flags->bitpix, "-32, or 8 for a sample of whole numbers from 0 to 255")
        ->check(CLI::IsMember({-32, 8}))
        ->capture_default_str();
    return [flags] {
        const auto done = sample(*flags);
        return done ? 0 : daemon::refuse("shearwater sample", done.error());
    };
}

}  // namespace shearwater::deploy
