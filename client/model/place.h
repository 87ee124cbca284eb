#pragma once
// Where a cube is to be seen, as a person types it in one line: a cube's file here, a running server, or a
// cube on another machine.

#include <functional>
#include <string>
#include <string_view>

#include "common/base/result.h"
#include "protocol/wire/events.h"
#include "protocol/wire/serving.h"

namespace shearwater::model {

struct Place {
    enum class Kind {
        here,       // a file, or a cube by formula
        server,     // HOST:PORT
        elsewhere,  // [USER@]HOST:PATH, by ssh
    };
    Kind kind = Kind::here;
    std::string name;        // as it can be typed anywhere: a file's path is absolute. Any bytes
    wire::Address address;   // of a server
    wire::RemoteCube there;  // elsewhere
    bool operator==(const Place&) const = default;
};

// What the text is read by.
struct Here {
    std::function<bool(const std::string& path)> exists;
    std::string folder;  // that relative paths begin in, absolute
    std::string home;    // for "~/"; may be empty
};

// A name that is a file's here is that file; blanks around it count only then. Else HOST:PORT comes first,
// then HOST:PATH, and what is neither is a file's path. invalid_argument: nothing is typed, or a port is
// none.
base::Result<Place> place_from(std::string_view typed, const Here& here);

// "the server at localhost, port 7500"; printable.
std::string in_words(const Place& place);
// What else a person may try when it cannot be reached; printable, or empty.
std::string advice(const Place& place);

// Whether a file's name ends as those of cubes do: in FITS, perhaps compressed.
bool is_named_as_cube(std::string_view path);

}  // namespace shearwater::model
