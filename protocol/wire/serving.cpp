#include "protocol/wire/serving.h"

#include <sstream>

namespace shearwater::wire {

std::optional<RemoteCube> remote_cube(std::string_view name) {
    const std::size_t colon = name.find(':');
    const bool looks_so = colon != name.npos && colon > 0 && colon + 1 < name.size() &&
                          name.find('/') > colon && !name.starts_with('-');
    if (!looks_so || name.starts_with("synthetic:")) {
        return std::nullopt;
    }
    return RemoteCube{std::string(name.substr(0, colon)), std::string(name.substr(colon + 1))};
}

std::vector<std::string> serving_here(const std::string& program, const std::vector<std::string>& arguments) {
    std::vector<std::string> words{program, "serve", "--stdio"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
}

std::vector<std::string> serving_there(const RemoteShell& shell, const std::string& host,
                                       const std::vector<std::string>& arguments) {
    std::vector<std::string> words;
    std::istringstream ssh(shell.ssh);
    for (std::string word; ssh >> word;) {
        words.push_back(word);
    }
    std::string line = "exec " + shell_word(shell.program) + " serve --stdio";
    for (const std::string& argument : arguments) {
        line += " " + shell_word(argument);
    }
    words.insert(words.end(), {"-T", host, line});
    return words;
}

std::string shell_word(const std::string& word) {
    std::string made = "'";
    for (const char c : word) {
        made += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return made + "'";
}

}  // namespace shearwater::wire
