#pragma once
// Transfer functions that a person keeps: TOML files in a folder, a file for each, read by --tf as they are.

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/view/anchored_function.h"

namespace shearwater::ui {

class PresetFolder {
  public:
    // $XDG_CONFIG_HOME/shearwater/presets, else ~/.config/shearwater/presets.
    static PresetFolder of_user();
    explicit PresetFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // Names are file names without ".toml": letters, digits, blanks and -_.,+()%, not beginning with a dot.
    static constexpr std::size_t longest_name = 64;
    static bool is_name(const std::string& name);

    // In alphabetical order, at most so many. No folder: none.
    static constexpr std::size_t most = 1000;
    std::vector<std::string> names() const;

    base::Result<view::AnchoredFunction> read(const std::string& name) const;
    // In the place of one of that name.
    base::Status write(const std::string& name, const view::AnchoredFunction& function) const;
    // Not onto another.
    base::Status rename(const std::string& from, const std::string& to) const;
    base::Status remove(const std::string& name) const;

  private:
    base::Result<std::filesystem::path> file_of(const std::string& name) const;

    std::filesystem::path folder_;  // empty: there is no home
};

}  // namespace shearwater::ui
