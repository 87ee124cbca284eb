#include "deploy/session_secret.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace shearwater::deploy {
namespace {

std::filesystem::path secrets_folder() {
    if (const char* runtime = std::getenv("XDG_RUNTIME_DIR"); runtime != nullptr && *runtime != '\0') {
        return std::filesystem::path(runtime) / "shearwater";
    }
    const char* const home = std::getenv("HOME");
    return std::filesystem::path(home != nullptr ? home : "/tmp") / ".local/state/shearwater";
}

}  // namespace

base::Result<ChosenSecret> choose_secret(const std::string& file) {
    const std::string variable(link::Secret::variable);
    if (file.empty() && std::getenv(variable.c_str()) == nullptr) {
        return ChosenSecret{link::Secret::random(), true};
    }
    const auto found = link::Secret::find(file);
    if (!found) {
        return found.error();
    }
    return ChosenSecret{*found, false};
}

base::Result<std::string> keep_secret(const link::Secret& secret, unsigned port) {
    const std::filesystem::path folder = secrets_folder();
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all, failed);
    const std::string path = (folder / (std::to_string(port) + ".secret")).string();
    std::filesystem::remove(path, failed);
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    const std::string line = secret.text() + "\n";
    const bool written =
        file >= 0 && write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size());
    const int reason = errno;
    if (file >= 0) {
        close(file);
    }
    if (!written) {
        return base::error(base::Code::io, "write " + path, std::strerror(reason));
    }
    return path;
}

}  // namespace shearwater::deploy
