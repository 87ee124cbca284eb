#pragma once
// Cubes on other machines, reached by ssh.

#include <optional>
#include <string>
#include <vector>

#include "common/options/cli_fwd.h"
#include "protocol/wire/serving.h"

namespace shearwater::deploy {

// What [USER@]HOST:PATH names; nothing where it is the name of a file here, or of a cube by formula.
std::optional<wire::RemoteCube> remote_cube(const std::string& name);

struct RemoteOptions {
    wire::RemoteShell shell;

    void add_to(CLI::App& app);
};

struct TargetOptions;
// The words that start a tree as the options say, where their cube lies: here, or there.
std::vector<std::string> serving_command(const TargetOptions& options, const std::string& log_level);

}  // namespace shearwater::deploy
