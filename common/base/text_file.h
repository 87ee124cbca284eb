#pragma once
// Small files of text, as a rule TOML: transfer functions, topologies, what a window keeps.

#include <filesystem>
#include <string>
#include <string_view>

#include "common/base/result.h"

namespace shearwater::base {

// The whole text of a regular file ("-": standard input) of at most `most_bytes`.
Result<std::string> read_text_file(const std::string& path, std::size_t most_bytes);

// Makes the folder and those on the way to it where they are missing, the last for nobody else to read.
Status make_own_folder(const std::filesystem::path& folder);

// Puts the text in the place of whatever the file held: whole, or not at all. Its folder is made where it is
// missing.
Status write_text_file(const std::string& path, std::string_view text);

}  // namespace shearwater::base
