#pragma once
// Opacity functions as the bytes of a file:
//
//     magic "SWOF" | version | length of the name | name | length of the codes | codes | checksum of all
//     before
//       4 bytes         4             8                            8                      8
//
// all little-endian. The name says what the functions are of, in full; whoever reads them knows it, and the
// blocks and directions that belong to it, so that nothing in a file decides how much is allocated.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/culling/function_store.h"
#include "common/culling/function_table.h"
#include "common/volume/box.h"
#include "common/volume/mapping.h"

namespace shearwater::cache {

// Rises with every change of the format, or of what functions are.
inline constexpr std::uint32_t version = 2;

// A cube as it was when it was opened.
struct Origin {
    std::string path;
    std::uint64_t bytes = 0;    // of the file; 0 where the path is a formula's name
    std::int64_t modified = 0;  // when, by the file system's clock
    int hdu = 0;
    std::int64_t plane = 0;
};

// What functions are of: a box of a cube, in codes by a mapping.
struct Content {
    Origin origin;
    volume::Index3 n;
    volume::Box box;
    volume::Mapping mapping;
    std::int64_t block_edge;
    int side;  // of the direction grid
    culling::FunctionKey key;
};

// Different for any two that differ.
std::string name_of(const Content& content);

std::uint64_t checksum(std::string_view bytes);

// A table of all of the box's blocks.
std::string file_of(std::string_view name, const culling::FunctionTable& table);
// How many bytes that has.
std::size_t file_size(std::string_view name, std::size_t codes);

// The codes of a file of so many; none if it is of another name or version, or damaged in any way.
std::optional<std::vector<std::uint8_t>> codes_from(std::string_view file, std::string_view name,
                                                    std::size_t codes);

}  // namespace shearwater::cache
