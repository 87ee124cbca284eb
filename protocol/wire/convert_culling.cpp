#include "protocol/wire/convert_culling.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/check.h"
#include "common/volume/levels.h"
#include "protocol/wire/convert.h"
#include "protocol/wire/convert_fields.h"

namespace shearwater::wire {

namespace {

// Some of a table's directions, and their codes.
std::pair<pb::Functions, base::Buffer> part_of(std::uint64_t number, int place, bool coarse,
                                               const culling::FunctionTable& table, std::size_t first,
                                               std::size_t directions) {
    const std::size_t count = table.block_count();
    pb::Functions part;
    part.set_number(number);
    part.set_place(static_cast<std::uint32_t>(place));
    part.set_coarse(coarse);
    *part.mutable_blocks() = to_wire(table.blocks);
    part.set_side(static_cast<std::uint32_t>(table.side));
    part.set_first_direction(static_cast<std::uint32_t>(first));
    part.set_directions(static_cast<std::uint32_t>(directions));
    const auto codes = std::as_bytes(std::span(table.codes).subspan(first * count, directions * count));
    return {std::move(part), base::Buffer(codes.begin(), codes.end())};
}

}  // namespace

pb::Culling to_wire(const culling::Settings& settings) {
    pb::Culling to;
    to.set_kind(static_cast<pb::CullingKind>(settings.kind));
    to.set_threshold(settings.threshold);
    return to;
}

Parsed<culling::Settings> culling_from(const pb::Culling& from) {
    const culling::Settings settings{static_cast<culling::Kind>(from.kind()), from.threshold()};
    if (const auto status = culling::validate(settings); !status) {
        return invalid(status.error());
    }
    return settings;
}

pb::FunctionKey to_wire(const culling::FunctionKey& key) {
    pb::FunctionKey to;
    to.set_footprint(key.footprint == culling::Footprint::column ? pb::FOOTPRINT_COLUMN
                                                                 : pb::FOOTPRINT_BLOCK);
    *to.mutable_basis() = to_wire(culling::at_height(key.basis, 1));
    to.set_level(static_cast<std::uint32_t>(key.level));
    return to;
}

Parsed<culling::FunctionKey> function_key_from(const pb::FunctionKey& key) {
    if (!pb::Footprint_IsValid(key.footprint())) {
        return invalid("function_key.footprint: an unknown one");
    }
    const auto basis = transfer_function_from(key.basis());
    if (!basis) {
        return basis.error();
    }
    auto members = culling::members_of(*basis);
    if (members.size() != 1 || std::abs(members[0].height - 1) > 1e-9) {
        return invalid("function_key.basis: one pin of height 1 is wanted");
    }
    if (key.level() > volume::max_level) {
        return invalid("function_key.level: there is no such level");
    }
    return culling::FunctionKey{.footprint = key.footprint() == pb::FOOTPRINT_COLUMN
                                                 ? culling::Footprint::column
                                                 : culling::Footprint::block,
                                .basis = std::move(members[0].basis),
                                .level = static_cast<int>(key.level())};
}

std::string bits_of(const culling::BlockSet& blocks) {
    std::string bits((blocks.size() + 7) / 8, 0);
    for (std::size_t n = 0; n < bits.size(); ++n) {
        unsigned byte = 0;
        for (std::size_t block = 8 * n; block < std::min(8 * n + 8, blocks.size()); ++block) {
            byte |= unsigned{blocks.contains(block)} << block % 8;
        }
        bits[n] = static_cast<char>(byte);
    }
    return bits;
}

std::optional<culling::BlockSet> blocks_from(std::string_view bits, std::size_t blocks) {
    if (bits.size() != (blocks + 7) / 8) {
        return std::nullopt;
    }
    culling::BlockSet set(blocks);
    for (std::size_t block = 0; block < blocks; ++block) {
        const auto byte = static_cast<unsigned char>(bits[block / 8]);
        set.bytes()[block] = static_cast<std::uint8_t>(byte >> block % 8 & 1U);
    }
    return set;
}

void put(const culling::VisibleBlocks& visible, pb::Render& render) {
    base::check(visible.blocks.size() <= most_blocks, "a frame's request has room for its blocks");
    if (visible.blocks.count() == visible.blocks.size()) {
        return;
    }
    render.set_visible(bits_of(visible.blocks));
    render.set_block_edge(static_cast<std::uint32_t>(visible.grid.edge()));
}

Parsed<std::optional<culling::VisibleBlocks>> visible_from(const pb::Render& render,
                                                           const volume::Index3& n) {
    if (render.block_edge() == 0) {
        return std::optional<culling::VisibleBlocks>();
    }
    if (render.block_edge() != 16 && render.block_edge() != 32) {
        return invalid("render.block_edge: 16 or 32 is wanted");
    }
    const culling::BlockGrid grid(n, render.block_edge());
    auto blocks = grid.size() <= most_blocks ? blocks_from(render.visible(), grid.size())
                                             : std::optional<culling::BlockSet>();
    if (!blocks) {
        return invalid("render.visible: a bit for each block is wanted");
    }
    return std::optional(culling::VisibleBlocks{grid, *std::move(blocks)});
}

std::vector<Message> functions_messages(std::uint64_t number, int place, bool coarse,
                                        const culling::FunctionTable& table) {
    const std::size_t count = table.block_count();
    const std::size_t all = table.codes.size() / count;
    const std::size_t at_once = std::max<std::size_t>(most_codes / count, 1);
    std::vector<Message> messages;
    for (std::size_t first = 0; first < all; first += at_once) {
        auto [part, codes] = part_of(number, place, coarse, table, first, std::min(at_once, all - first));
        messages.push_back(message(std::move(part), std::move(codes)));
    }
    return messages;
}

Parsed<FunctionPart> functions_from(const pb::Functions& body, const Payload& payload) {
    constexpr std::uint32_t most_side = 360;
    const auto blocks = box_from(body.blocks());
    if (!blocks) {
        return blocks.error();
    }
    std::uint64_t count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        count *= static_cast<std::uint64_t>(blocks->cells(axis));
        if (count == 0 || count > most_blocks) {
            return invalid("functions.blocks: some are wanted, and not too many");
        }
    }
    const std::uint32_t side = body.side();
    if (side == 0 || side % 4 != 0 || side > most_side) {
        return invalid("functions.side: a direction grid's is wanted");
    }
    const std::uint32_t all = side * side / 2;
    if (body.directions() == 0 || body.first_direction() >= all ||
        body.directions() > all - body.first_direction()) {
        return invalid("functions.directions: some of the grid's are wanted");
    }
    if (payload == nullptr || payload->size() != count * body.directions()) {
        return invalid("functions: a byte for each block and direction is wanted");
    }
    return FunctionPart{.number = body.number(),
                        .place = static_cast<int>(body.place()),
                        .coarse = body.coarse(),
                        .blocks = *blocks,
                        .side = static_cast<int>(side),
                        .first_direction = static_cast<int>(body.first_direction()),
                        .directions = static_cast<int>(body.directions()),
                        .codes = *payload};
}

Message give_functions(std::uint64_t request, const culling::FunctionKey& key, std::uint64_t number,
                       const culling::FunctionTable& table, int first_direction) {
    const auto first = static_cast<std::size_t>(first_direction);
    const std::size_t count = table.block_count();
    const std::size_t directions =
        std::min(std::max<std::size_t>(most_given / count, 1), table.codes.size() / count - first);
    auto [part, codes] = part_of(number, 0, false, table, first, directions);
    pb::GiveFunctions give;
    give.set_request(request);
    *give.mutable_key() = to_wire(key);
    *give.mutable_functions() = std::move(part);
    return message(std::move(give), std::move(codes));
}

Parsed<GivenFunctions> given_functions_from(const Message& message) {
    const auto& body = std::get<pb::GiveFunctions>(message.body);
    auto key = function_key_from(body.key());
    if (!key) {
        return key.error();
    }
    const auto part = functions_from(body.functions(), message.payload);
    if (!part) {
        return part.error();
    }
    return GivenFunctions{body.request(), *std::move(key), *part};
}

}  // namespace shearwater::wire
