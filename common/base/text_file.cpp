#include "common/base/text_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

namespace shearwater::base {

Result<std::string> read_text_file(const std::string& path, std::size_t most_bytes) {
    const std::string operation = "read " + path;
    std::ifstream file;
    if (path != "-") {
        std::error_code failed;
        if (!std::filesystem::is_regular_file(path, failed)) {
            return error(Code::not_found, operation, failed ? failed.message() : "not a regular file");
        }
        file.open(path, std::ios::binary);
    }
    std::istream& in = path == "-" ? std::cin : file;
    if (!in) {
        return error(Code::io, operation, "cannot be opened");
    }
    std::string text(most_bytes + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (text.size() > most_bytes) {
        return error(Code::too_large, operation, "more than " + std::to_string(most_bytes) + " bytes");
    }
    return text;
}

Status make_own_folder(const std::filesystem::path& folder) {
    namespace fs = std::filesystem;
    std::error_code failed;
    if (fs::exists(folder, failed)) {
        return {};
    }
    fs::create_directories(folder, failed);
    if (failed) {
        return error(Code::io, "make folder " + folder.string(), failed.message());
    }
    fs::permissions(folder, fs::perms::owner_all, failed);
    return {};
}

Status write_text_file(const std::string& path, std::string_view text) {
    namespace fs = std::filesystem;
    const std::string operation = "write " + path;
    std::error_code failed;
    if (const fs::path folder = fs::path(path).parent_path(); !folder.empty()) {
        if (const auto made = make_own_folder(folder); !made) {
            return error(Code::io, operation, made.error().detail);
        }
    }
    const std::string part = path + "." + std::to_string(getpid()) + ".part";
    std::ofstream file(part, std::ios::binary | std::ios::trunc);
    file << text;
    file.close();
    if (file) {
        fs::rename(part, path, failed);
        if (!failed) {
            return {};
        }
    }
    const std::string why = failed ? failed.message() : std::strerror(errno);
    fs::remove(part, failed);
    return error(Code::io, operation, why);
}

}  // namespace shearwater::base
