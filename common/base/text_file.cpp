#include "common/base/text_file.h"

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

}  // namespace shearwater::base
