#include "client/model/place.h"

#include <algorithm>
#include <cctype>

namespace shearwater::model {

namespace {

constexpr std::string_view formula = "synthetic:";

std::string_view without_blanks(std::string_view text) {
    constexpr std::string_view blank = " \t\r\n";
    const std::size_t first = text.find_first_not_of(blank);
    return first == text.npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

// As people write addresses: one colon with nothing but digits behind it, or brackets.
bool looks_like_address(std::string_view text) {
    if (text.starts_with('[')) {
        return true;
    }
    const std::size_t colon = text.find(':');
    return colon != text.npos && colon > 0 && text.find_first_of("/@") == text.npos &&
           text.find_first_not_of("0123456789", colon + 1) == text.npos;
}

bool looks_like_path(std::string_view text) {
    return text.starts_with('/') || text.starts_with("./") || text.starts_with("../") ||
           text.starts_with("~/");
}

std::string absolute(std::string_view path, const Here& here) {
    if (path.starts_with('/')) {
        return std::string(path);
    }
    if (path.starts_with("~/") && !here.home.empty()) {
        return here.home + std::string(path.substr(1));
    }
    if (path.starts_with("./")) {
        path.remove_prefix(2);
    }
    return here.folder + (here.folder.ends_with('/') ? "" : "/") + std::string(path);
}

base::Result<Place> server_at(std::string_view text) {
    const auto address = wire::parse_address(text, 0);
    if (!address) {
        return address.error();
    }
    if (address->port == 0) {
        return base::error(base::Code::invalid_argument, "address '" + base::printable(text) + "'",
                           "the port is missing: HOST:PORT");
    }
    return Place{
        .kind = Place::Kind::server, .name = wire::to_string(*address), .address = *address, .there = {}};
}

}  // namespace

base::Result<Place> place_from(std::string_view typed, const Here& here) {
    const bool exact = !typed.empty() && here.exists(absolute(typed, here));
    const std::string_view text = exact ? typed : without_blanks(typed);
    if (text.empty()) {
        return base::error(base::Code::invalid_argument, "", "Type where the cube is first.");
    }
    const auto file = [&](std::string name) {
        return Place{.kind = Place::Kind::here, .name = std::move(name), .address = {}, .there = {}};
    };
    if (text.starts_with(formula) && !exact) {
        return file(std::string(text));
    }
    if (exact || looks_like_path(text) || here.exists(absolute(text, here))) {
        return file(absolute(text, here));
    }
    if (looks_like_address(text)) {
        return server_at(text);
    }
    if (auto there = wire::remote_cube(text)) {
        return Place{.kind = Place::Kind::elsewhere,
                     .name = std::string(text),
                     .address = {},
                     .there = *std::move(there)};
    }
    return file(absolute(text, here));
}

std::string in_words(const Place& place) {
    switch (place.kind) {
        case Place::Kind::server:
            return base::printable("the server at " + place.address.host + ", port " +
                                   std::to_string(place.address.port));
        case Place::Kind::elsewhere:
            return base::printable("a cube on " + place.there.host + ", by ssh");
        case Place::Kind::here:
            break;
    }
    return place.name.starts_with(formula) ? "a cube that is made by formula" : "a cube on this machine";
}

std::string advice(const Place& place) {
    switch (place.kind) {
        case Place::Kind::server:
            return "";
        case Place::Kind::elsewhere:
            return base::printable("In a terminal, \"ssh " + place.there.host +
                                   "\" shows whether that machine lets you in; Shearwater has to be "
                                   "installed there, and on the path.");
        case Place::Kind::here:
            break;
    }
    return place.name.starts_with(formula) ? "\"shearwater sample --help\" lists the kinds."
                                           : "\"shearwater info FILE\" says what a file holds.";
}

bool is_named_as_cube(std::string_view path) {
    std::string name(path);
    std::ranges::transform(name, name.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const std::string_view tail : {".gz", ".fz"}) {
        if (name.ends_with(tail)) {
            name.resize(name.size() - tail.size());
        }
    }
    return name.ends_with(".fits") || name.ends_with(".fit") || name.ends_with(".fts");
}

}  // namespace shearwater::model
