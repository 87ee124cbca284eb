#pragma once
// How a function says that something outside our control went wrong: a file, a peer or a user.
// Our own mistakes are not errors but failed checks (check.h).

#include <boost/system/result.hpp>
#include <string>
#include <string_view>

namespace shearwater::base {

enum class Code {
    invalid_argument,  // a user's or a peer's value that cannot be used
    not_found,
    unsupported,  // well formed, but nothing we can do with it
    corrupt,      // contradicts itself, or is cut off
    too_large,    // beyond a limit of ours
    io,           // the operating system said no
    refused,      // a peer said no
    timed_out,
    cancelled,
};

// The code in words, for messages and tests: "invalid argument", "not found", ...
std::string_view name(Code code);

struct Error {
    Code code;
    std::string operation;  // what was being done, with its object: "open ngc6946.fits"
    std::string detail;     // why it failed, in a user's words

    // "operation: detail", free of control characters, on one line.
    std::string message() const;
};

[[noreturn]] void throw_exception_from_error(const Error& error, const boost::source_location& where);

template <class T>
using Result = boost::system::result<T, Error>;
using Status = Result<void>;

inline Error error(Code code, std::string operation, std::string detail) {
    return Error{code, std::move(operation), std::move(detail)};
}

// Text from a file or a peer made safe for a terminal: control characters and bytes that are not
// printable ASCII become '?', and what is longer than `limit` characters is cut with "...".
std::string printable(std::string_view text, std::size_t limit = 200);

}  // namespace shearwater::base
