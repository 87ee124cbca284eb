#pragma once
// Small files of text, as a rule TOML: transfer functions, topologies, what a window keeps.

#include <string>
#include <string_view>

#include "common/base/result.h"

namespace shearwater::base {

// The whole text of a regular file ("-": standard input) of at most `most_bytes`.
Result<std::string> read_text_file(const std::string& path, std::size_t most_bytes);

// Puts the text in the place of whatever the file held: whole, or not at all. Folders on the way to it are
// made where they are missing, for nobody else to read.
Status write_text_file(const std::string& path, std::string_view text);

}  // namespace shearwater::base
