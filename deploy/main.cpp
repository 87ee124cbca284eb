// shearwater: the one command a person types.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "deploy/commands.h"
#include "protocol/daemon/options.h"
#include "protocol/daemon/runtime.h"

using namespace shearwater;

int main(int argc, char** argv) {
    CLI::App app("Shearwater: distributed volume rendering of astronomical cubes.", "shearwater");
    app.set_version_flag("--version", SHEARWATER_VERSION);
    app.require_subcommand(1);
    using Add = deploy::Run (*)(CLI::App&);
    const std::vector<std::tuple<const char*, const char*, Add>> commands{
        {"view", "show a cube in a window, on a local tree or a running server", deploy::add_view},
        {"serve", "start a tree for a cube and keep it running", deploy::add_serve},
        {"snapshot", "draw one picture of a cube into a PNG file", deploy::add_snapshot},
        {"movie", "draw a flight past cubes, frame by frame or as a film", deploy::add_movie},
        {"info", "say what a FITS file holds", deploy::add_info},
        {"sample", "make a sample cube", deploy::add_sample},
        {"bench", "measure how fast pictures are drawn here", deploy::add_bench},
    };
    std::vector<std::pair<CLI::App*, deploy::Run>> runs;
    for (const auto& [name, about, add] : commands) {
        CLI::App* const command = app.add_subcommand(name, about);
        runs.emplace_back(command, add(*command));
    }
    const std::string typed = argc > 1 ? argv[1] : "";
    const bool known =
        typed.empty() || typed.starts_with('-') ||
        std::ranges::any_of(commands, [&](const auto& command) { return std::get<0>(command) == typed; });
    if (!known) {
        return daemon::refuse("shearwater", base::error(base::Code::invalid_argument, typed,
                                                        "no such command; see shearwater --help"));
    }
    if (const auto status = daemon::parse(app, argc, argv)) {
        return *status;
    }
    for (const auto& [command, run] : runs) {
        if (command->parsed()) {
            return run();
        }
    }
    return 2;
}
