#pragma once
// Small text files that a person wrote: transfer functions, topologies.

#include <string>

#include "common/base/result.h"

namespace shearwater::base {

// The whole text of a regular file ("-": standard input) of at most `most_bytes`.
Result<std::string> read_text_file(const std::string& path, std::size_t most_bytes);

}  // namespace shearwater::base
