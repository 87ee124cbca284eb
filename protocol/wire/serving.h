#pragma once
// The commands that start a server for one client, which then speaks with it through their standard streams:
// `shearwater serve CUBE --stdio` on this machine, or by ssh on another, where nothing listens but that
// machine's own tree, on its loopback.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shearwater::wire {

struct RemoteCube {
    std::string host;  // as ssh takes it: HOST or USER@HOST
    std::string path;
    bool operator==(const RemoteCube&) const = default;
};
// What [USER@]HOST:PATH names; nothing where a text reads as a file's name or that of a cube by formula. The
// names of files that are here come first: whoever can look does so before.
std::optional<RemoteCube> remote_cube(std::string_view name);

// How another machine is reached.
struct RemoteShell {
    std::string ssh = "ssh";  // with options of its own behind blanks
    std::string program = "shearwater";
};

// `arguments`: those of `shearwater serve`, the cube first.
std::vector<std::string> serving_here(const std::string& program, const std::vector<std::string>& arguments);
std::vector<std::string> serving_there(const RemoteShell& shell, const std::string& host,
                                       const std::vector<std::string>& arguments);

// A word as a shell reads it back.
std::string shell_word(const std::string& word);

}  // namespace shearwater::wire
