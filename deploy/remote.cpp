#include "deploy/remote.h"

#include <CLI/CLI.hpp>
#include <filesystem>

#include "common/base/own_program.h"
#include "deploy/target.h"

namespace shearwater::deploy {

std::optional<wire::RemoteCube> remote_cube(const std::string& name) {
    std::error_code ignored;
    return std::filesystem::exists(name, ignored) ? std::nullopt : wire::remote_cube(name);
}

void RemoteOptions::add_to(CLI::App& app) {
    const std::string group = "Another machine";
    app.add_option("--ssh", shell.ssh, "how to start ssh, with options of its own")
        ->capture_default_str()
        ->group(group);
    app.add_option("--remote-program", shell.program, "shearwater's name or path there")
        ->capture_default_str()
        ->group(group);
}

std::vector<std::string> serving_command(const TargetOptions& options, const std::string& log_level) {
    options::CubeOptions cube = options.cube;
    const auto there = remote_cube(cube.path);
    cube.path = there ? there->path : cube.path;
    std::vector<std::string> arguments = cube.arguments();
    const std::vector<std::string> tree = options.tree.arguments();
    arguments.insert(arguments.end(), tree.begin(), tree.end());
    arguments.insert(arguments.end(), {"--threads", std::to_string(options.threads), "--log", log_level});
    return there ? wire::serving_there(options.remote.shell, there->host, arguments)
                 : wire::serving_here(base::beside_this_program("shearwater"), arguments);
}

}  // namespace shearwater::deploy
