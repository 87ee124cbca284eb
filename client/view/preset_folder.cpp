#include "client/view/preset_folder.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "common/base/text_file.h"

namespace shearwater::ui {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 20;
constexpr std::string_view ending = ".toml";

base::Status said(const char* what, const fs::path& path, const std::error_code& fault) {
    if (!fault) {
        return {};
    }
    return base::error(base::Code::io, std::string(what) + " " + path.string(), fault.message());
}

}  // namespace

PresetFolder PresetFolder::of_user() {
    const char* config = std::getenv("XDG_CONFIG_HOME");
    const char* home = std::getenv("HOME");
    if (config != nullptr && fs::path(config).is_absolute()) {
        return PresetFolder(fs::path(config) / "shearwater" / "presets");
    }
    const bool has_home = home != nullptr && *home != 0;
    return PresetFolder(has_home ? fs::path(home) / ".config" / "shearwater" / "presets" : fs::path());
}

bool PresetFolder::is_name(const std::string& name) {
    const auto good = [](unsigned char c) {
        return std::isalnum(c) != 0 ||
               std::string_view(" -_.,+()%").find(static_cast<char>(c)) != std::string_view::npos;
    };
    return !name.empty() && name.size() <= longest_name && name.front() != '.' && name.front() != ' ' &&
           name.back() != ' ' && std::all_of(name.begin(), name.end(), good);
}

std::vector<std::string> PresetFolder::names() const {
    std::vector<std::string> names;
    std::error_code fault;
    fs::directory_iterator entry(folder_, fault);
    for (; !fault && entry != fs::directory_iterator() && names.size() < most; entry.increment(fault)) {
        std::string name = entry->path().filename().string();
        std::error_code none;
        if (name.ends_with(ending) && entry->is_regular_file(none)) {
            name.resize(name.size() - ending.size());
            if (is_name(name)) {
                names.push_back(std::move(name));
            }
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

base::Result<fs::path> PresetFolder::file_of(const std::string& name) const {
    if (folder_.empty()) {
        return base::error(base::Code::not_found, "find the presets", "HOME is not set");
    }
    if (!is_name(name)) {
        return base::error(base::Code::invalid_argument, "preset '" + name + "'",
                           "names are of letters, digits, blanks and -_.,+()%, 64 at most");
    }
    return folder_ / (name + std::string(ending));
}

base::Result<view::AnchoredFunction> PresetFolder::read(const std::string& name) const {
    const auto file = file_of(name);
    if (!file) {
        return file.error();
    }
    const auto text = base::read_text_file(file->string(), most_bytes);
    return text ? view::transfer_function_from_toml(*text, "'" + name + "'") : text.error();
}

base::Status PresetFolder::write(const std::string& name, const view::AnchoredFunction& function) const {
    const auto file = file_of(name);
    return file ? base::write_text_file(file->string(), view::to_toml(function)) : file.error();
}

base::Status PresetFolder::rename(const std::string& from, const std::string& to) const {
    const auto source = file_of(from);
    const auto target = file_of(to);
    if (!source || !target) {
        return source ? target.error() : source.error();
    }
    std::error_code fault;
    if (fs::exists(*target, fault)) {
        return base::error(base::Code::invalid_argument, "rename preset '" + from + "'",
                           "there is one named '" + to + "'");
    }
    fs::rename(*source, *target, fault);
    return said("rename", *source, fault);
}

base::Status PresetFolder::remove(const std::string& name) const {
    const auto file = file_of(name);
    if (!file) {
        return file.error();
    }
    std::error_code fault;
    if (!fs::remove(*file, fault) && !fault) {
        return base::error(base::Code::not_found, "delete preset '" + name + "'", "there is none");
    }
    return said("delete", *file, fault);
}

}  // namespace shearwater::ui
