#pragma once
// For our own mistakes only: a failed check says where, and ends the program.

#include <boost/assert/source_location.hpp>
#include <string_view>

namespace shearwater::base {

[[noreturn]] void check_failed(std::string_view what, const boost::source_location& where);

inline void check(bool holds, std::string_view what,
                  const boost::source_location& where = BOOST_CURRENT_LOCATION) {
    if (!holds) [[unlikely]] {
        check_failed(what, where);
    }
}

}  // namespace shearwater::base
