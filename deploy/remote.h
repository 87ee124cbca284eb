#pragma once
// Cubes on other machines, reached by ssh: `shearwater serve --stdio` is started there and speaks with us
// through ssh's standard streams. Nothing listens but that machine's own tree, on its loopback.

#include <optional>
#include <string>
#include <vector>

#include "common/options/cli_fwd.h"

namespace shearwater::deploy {

struct RemoteCube {
    std::string host;  // as ssh takes it: HOST or USER@HOST
    std::string path;
};
// What [USER@]HOST:PATH names; nothing where it is the name of a file here, or of a cube by formula.
std::optional<RemoteCube> remote_cube(const std::string& name);

struct RemoteOptions {
    std::string ssh = "ssh";
    std::string program = "shearwater";

    void add_to(CLI::App& app);
};

struct TargetOptions;
// The words that start a tree there as the options say.
std::vector<std::string> serving_command(const RemoteCube& cube, const TargetOptions& options);

// A word as a shell reads it back.
std::string shell_word(const std::string& word);

}  // namespace shearwater::deploy
