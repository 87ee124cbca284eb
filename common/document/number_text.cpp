#include "common/document/number_text.h"

#include <fmt/core.h>

namespace shearwater::document {

std::string number_text(double value) {
    std::string digits = fmt::format("{}", value);
    return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
}

}  // namespace shearwater::document
