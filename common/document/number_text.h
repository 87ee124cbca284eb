#pragma once
// Numbers as TOML documents have them.

#include <string>

namespace shearwater::document {

// The shortest text that reads back as the same number, and as a float.
std::string number_text(double value);

}  // namespace shearwater::document
