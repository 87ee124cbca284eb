#include "common/base/result.h"

#include <stdexcept>

namespace shearwater::base {

std::string_view name(Code code) {
    switch (code) {
        case Code::invalid_argument:
            return "invalid argument";
        case Code::not_found:
            return "not found";
        case Code::unsupported:
            return "unsupported";
        case Code::corrupt:
            return "corrupt";
        case Code::too_large:
            return "too large";
        case Code::io:
            return "input/output";
        case Code::refused:
            return "refused";
        case Code::timed_out:
            return "timed out";
        case Code::cancelled:
            return "cancelled";
    }
    return "unknown";
}

std::string Error::message() const {
    constexpr std::size_t longest = 1000;
    return printable(operation.empty() ? detail : operation + ": " + detail, longest);
}

void throw_exception_from_error(const Error& error, const boost::source_location&) {
    throw std::runtime_error(error.message());
}

std::string printable(std::string_view text, std::size_t limit) {
    std::string safe;
    for (const char c : text.substr(0, limit)) {
        safe += c >= ' ' && c <= '~' ? c : '?';
    }
    if (text.size() > limit) {
        safe += "...";
    }
    return safe;
}

}  // namespace shearwater::base
