#include "deploy/remote.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <sstream>

#include "deploy/target.h"

namespace shearwater::deploy {

std::optional<RemoteCube> remote_cube(const std::string& name) {
    std::error_code ignored;
    const std::size_t colon = name.find(':');
    const bool looks_so = colon != std::string::npos && colon > 0 && colon + 1 < name.size() &&
                          name.find('/') > colon && !name.starts_with('-');
    if (!looks_so || name.starts_with("synthetic:") || std::filesystem::exists(name, ignored)) {
        return std::nullopt;
    }
    return RemoteCube{name.substr(0, colon), name.substr(colon + 1)};
}

void RemoteOptions::add_to(CLI::App& app) {
    const std::string group = "Another machine";
    app.add_option("--ssh", ssh, "how to start ssh, with options of its own")
        ->capture_default_str()
        ->group(group);
    app.add_option("--remote-program", program, "shearwater's name or path there")
        ->capture_default_str()
        ->group(group);
}

std::vector<std::string> serving_command(const RemoteCube& cube, const TargetOptions& options) {
    std::vector<std::string> words;
    std::istringstream ssh(options.remote.ssh);
    for (std::string word; ssh >> word;) {
        words.push_back(word);
    }
    words.insert(words.end(), {"-T", cube.host});
    options::CubeOptions there = options.cube;
    there.path = cube.path;
    std::vector<std::string> arguments = there.arguments();
    const std::vector<std::string> tree = options.tree.arguments();
    arguments.insert(arguments.end(), tree.begin(), tree.end());
    arguments.insert(arguments.end(), {"--threads", std::to_string(options.threads), "--log", "warn"});
    std::string line = "exec " + shell_word(options.remote.program) + " serve --stdio";
    for (const std::string& argument : arguments) {
        line += " " + shell_word(argument);
    }
    words.push_back(line);
    return words;
}

std::string shell_word(const std::string& word) {
    std::string made = "'";
    for (const char c : word) {
        made += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return made + "'";
}

}  // namespace shearwater::deploy
