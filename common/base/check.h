#pragma once
// For our own mistakes only: a failed check says where, and ends the program.

#include <source_location>
#include <string_view>

namespace shearwater::base {

[[noreturn]] void check_failed(std::string_view what, const std::source_location& where);

inline void check(bool holds, std::string_view what,
                  const std::source_location& where = std::source_location::current()) {
    if (!holds) [[unlikely]] {
        check_failed(what, where);
    }
}

}  // namespace shearwater::base
