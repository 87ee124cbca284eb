#pragma once
// Of opacity functions, and what they hide.

#include <optional>
#include <string>
#include <string_view>

#include "common/culling/block_grid.h"
#include "common/culling/function_store.h"
#include "protocol/wire/header.h"

namespace shearwater::wire {

// More blocks than this are all drawn: a frame's request has no room for them.
inline constexpr std::size_t most_blocks = std::size_t{3} << 19;
// Of bytes that travel at once.
inline constexpr std::size_t most_codes = std::size_t{8} << 20;

pb::Culling to_wire(const culling::Settings& settings);
Parsed<culling::Settings> culling_from(const pb::Culling& settings);

pb::FunctionKey to_wire(const culling::FunctionKey& key);
Parsed<culling::FunctionKey> function_key_from(const pb::FunctionKey& key);

// A bit a block, from the lowest of a byte on; and back, of so many blocks, if there are as many bits.
std::string bits_of(const culling::BlockSet& blocks);
std::optional<culling::BlockSet> blocks_from(std::string_view bits, std::size_t blocks);
// What is visible, into a frame's request, where not all is; and out of it, for a cube of n voxels, if it
// says.
void put(const culling::VisibleBlocks& visible, pb::Render& render);
Parsed<std::optional<culling::VisibleBlocks>> visible_from(const pb::Render& render, const volume::Index3& n);

// A table in as many messages as it takes.
std::vector<Message> functions_messages(std::uint64_t number, int place, bool coarse,
                                        const culling::FunctionTable& table);
// Which part of a table a message has: whole directions, of as many blocks and of a grid that keeps its
// limits.
struct FunctionPart {
    std::uint64_t number = 0;
    int place = 0;
    bool coarse = false;
    volume::Box blocks;
    int side = 0;
    int first_direction = 0, directions = 0;
    std::span<const std::byte> codes;
};
Parsed<FunctionPart> functions_from(const pb::Functions& body, const Payload& payload);
inline Parsed<FunctionPart> functions_from(const Message& message) {
    return functions_from(std::get<pb::Functions>(message.body), message.payload);
}

// Part of a whole cube's table for renderers, from a direction on: at most so many bytes, or one direction.
inline constexpr std::size_t most_given = std::size_t{1} << 20;
Message give_functions(std::uint64_t request, const culling::FunctionKey& key, std::uint64_t number,
                       const culling::FunctionTable& table, int first_direction);
struct GivenFunctions {
    std::uint64_t request = 0;
    culling::FunctionKey key;
    FunctionPart part;
};
Parsed<GivenFunctions> given_functions_from(const Message& message);

}  // namespace shearwater::wire
