// Opacity functions and visible blocks there and back, and what is refused.

#include "protocol/wire/convert_culling.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/wire/examples.h"

namespace shearwater::wire::test {
namespace {

const volume::Index3 n{100, 40, 33};  // 4 x 2 x 1 blocks

TEST(Culling, KeysComeBack) {
    const culling::FunctionKey key = function_key();
    EXPECT_EQ(function_key_from(to_wire(key)).value(), key);
}

TEST(Culling, KeysOutOfRangeAreRefused) {
    const pb::FunctionKey good = to_wire(function_key());
    pb::FunctionKey bad = good;
    bad.set_level(6);
    EXPECT_EQ(function_key_from(bad).error().reason, pb::REASON_INVALID);
    bad = good;
    bad.set_footprint(static_cast<pb::Footprint>(7));
    EXPECT_TRUE(function_key_from(bad).has_error());
    bad = good;
    bad.mutable_basis()->mutable_opacity_pins(0)->mutable_hat()->set_height(0.5);
    EXPECT_TRUE(function_key_from(bad).has_error()) << "not of height 1";
    bad = good;
    *bad.mutable_basis()->add_opacity_pins() = good.basis().opacity_pins(0);
    EXPECT_TRUE(function_key_from(bad).has_error()) << "two pins";
    bad = good;
    bad.mutable_basis()->clear_opacity_pins();
    EXPECT_TRUE(function_key_from(bad).has_error());
}

TEST(Culling, VisibleBlocksComeBack) {
    std::mt19937 random(1);
    culling::VisibleBlocks visible{culling::BlockGrid(n), culling::BlockSet(8)};
    for (int trial = 0; trial < 20; ++trial) {
        for (std::uint8_t& in : visible.blocks.bytes()) {
            in = static_cast<std::uint8_t>(random() % 2);
        }
        visible.blocks.bytes()[random() % 8] = 0;
        pb::Render render;
        put(visible, render);
        const auto back = visible_from(render, n).value();
        ASSERT_TRUE(back.has_value());
        EXPECT_EQ(back->grid, visible.grid);
        EXPECT_EQ(back->blocks, visible.blocks);
    }
    EXPECT_FALSE(visible_from(pb::Render(), n).value().has_value()) << "all are";
    pb::Render all;
    put({visible.grid, culling::BlockSet(8, true)}, all);
    EXPECT_EQ(all.ByteSizeLong(), 0U) << "all are";
}

TEST(Culling, VisibleBlocksOfAnotherCubeAreRefused) {
    pb::Render render;
    put({culling::BlockGrid(n), culling::BlockSet(8)}, render);
    EXPECT_TRUE(visible_from(render, {400, 40, 33}).has_error());
    render.set_block_edge(16);
    EXPECT_TRUE(visible_from(render, n).has_error());
    render.set_block_edge(31);
    EXPECT_TRUE(visible_from(render, n).has_error());
    render.set_block_edge(32);
    EXPECT_TRUE(visible_from(render, {1 << 20, 1 << 20, 1 << 20}).has_error()) << "too many";
}

culling::FunctionTable table(std::int64_t blocks, int side) {
    culling::FunctionTable table{.blocks = {{1, 0, 2}, {1 + blocks, 1, 3}}, .side = side, .codes = {}};
    std::mt19937 random(2);
    table.codes.resize(static_cast<std::size_t>(blocks) * static_cast<std::size_t>(side * side / 2));
    for (std::uint8_t& code : table.codes) {
        code = static_cast<std::uint8_t>(random());
    }
    return table;
}

TEST(Culling, TablesComeInParts) {
    for (const std::int64_t blocks : {std::int64_t{1}, std::int64_t{77}, std::int64_t{100000}}) {
        const culling::FunctionTable whole = table(blocks, 36);
        std::vector<std::byte> codes;
        int next = 0;
        for (const Message& message : functions_messages(9, 4, true, whole)) {
            ASSERT_LE(message.payload_size(), most_codes);
            const FunctionPart part = functions_from(message).value();
            EXPECT_EQ(part.number, 9U);
            EXPECT_EQ(part.place, 4);
            EXPECT_TRUE(part.coarse);
            EXPECT_EQ(part.blocks, whole.blocks);
            EXPECT_EQ(part.side, 36);
            EXPECT_EQ(part.first_direction, next);
            next += part.directions;
            codes.insert(codes.end(), part.codes.begin(), part.codes.end());
        }
        EXPECT_EQ(next, 648);
        EXPECT_TRUE(std::ranges::equal(codes, std::as_bytes(std::span(whole.codes))));
    }
}

TEST(Culling, PartsThatDoNotFitAreRefused) {
    const Message good = functions_messages(9, 4, false, table(3, 4)).at(0);
    EXPECT_TRUE(functions_from(good).has_value());
    const auto refused = [&](const auto& change) {
        Message bad = good;
        change(std::get<pb::Functions>(bad.body));
        return functions_from(bad).has_error();
    };
    EXPECT_TRUE(refused([](pb::Functions& m) { m.set_side(0); }));
    EXPECT_TRUE(refused([](pb::Functions& m) { m.set_side(6); }));
    EXPECT_TRUE(refused([](pb::Functions& m) { m.set_side(1U << 31); }));
    EXPECT_TRUE(refused([](pb::Functions& m) { m.set_directions(9); }));
    EXPECT_TRUE(refused([](pb::Functions& m) { m.set_directions(0); }));
    EXPECT_TRUE(refused([](pb::Functions& m) { m.set_directions(7); })) << "fewer bytes than that";
    EXPECT_TRUE(refused([](pb::Functions& m) { m.set_first_direction(1); }));
    EXPECT_TRUE(refused([](pb::Functions& m) { m.set_first_direction(0xffffffff); }));
    EXPECT_TRUE(refused([](pb::Functions& m) { m.mutable_blocks()->mutable_hi()->set_x(1); })) << "none";
    EXPECT_TRUE(
        refused([](pb::Functions& m) { m.mutable_blocks()->mutable_hi()->set_x(std::int64_t{1} << 39); }));
    Message empty = good;
    empty.payload = nullptr;
    EXPECT_TRUE(functions_from(empty).has_error());
}

TEST(Culling, TablesAreGivenInParts) {
    for (const std::int64_t blocks : {std::int64_t{1}, std::int64_t{9000}}) {
        const culling::FunctionTable whole = table(blocks, 36);
        std::vector<std::byte> codes;
        for (int next = 0; next < 648;) {
            const Message message = give_functions(31, function_key(), 9, whole, next);
            EXPECT_LE(message.payload_size(), most_given);
            const GivenFunctions given = given_functions_from(message).value();
            EXPECT_EQ(given.request, 31U);
            EXPECT_EQ(given.key, function_key());
            EXPECT_EQ(given.part.number, 9U);
            EXPECT_EQ(given.part.blocks, whole.blocks);
            ASSERT_EQ(given.part.first_direction, next);
            next += given.part.directions;
            codes.insert(codes.end(), given.part.codes.begin(), given.part.codes.end());
        }
        EXPECT_TRUE(std::ranges::equal(codes, std::as_bytes(std::span(whole.codes))));
    }
    // However many blocks there are, a direction at a time.
    EXPECT_EQ(given_functions_from(give_functions(1, function_key(), 9, table(most_given + 1, 4), 7))
                  .value()
                  .part.directions,
              1);
}

TEST(Culling, GivenPartsThatDoNotFitAreRefused) {
    const Message good = give_functions(31, function_key(), 9, table(3, 4), 0);
    EXPECT_TRUE(given_functions_from(good).has_value());
    Message bad = good;
    std::get<pb::GiveFunctions>(bad.body).mutable_key()->set_level(99);
    EXPECT_TRUE(given_functions_from(bad).has_error());
    bad = good;
    std::get<pb::GiveFunctions>(bad.body).mutable_functions()->set_directions(7);
    EXPECT_TRUE(given_functions_from(bad).has_error());
    bad = good;
    bad.payload = nullptr;
    EXPECT_TRUE(given_functions_from(bad).has_error());
}

TEST(Culling, BitsAreOfAsManyBlocks) {
    std::mt19937 random(3);
    for (const std::size_t blocks : {1, 7, 8, 9, 64, 1001}) {
        culling::BlockSet set(blocks);
        for (std::uint8_t& in : set.bytes()) {
            in = static_cast<std::uint8_t>(random() % 2);
        }
        const std::string bits = bits_of(set);
        EXPECT_EQ(bits.size(), (blocks + 7) / 8);
        EXPECT_EQ(blocks_from(bits, blocks), set);
        EXPECT_FALSE(blocks_from(bits + '\1', blocks));
        EXPECT_FALSE(blocks_from(std::string_view(bits).substr(1), blocks));
    }
}

TEST(Culling, SettingsOutOfRangeAreRefused) {
    View view = view_request();
    view.culling = {culling::Kind::pof, 0.95};
    pb::SetView sent = to_wire(view);
    EXPECT_EQ(view_from(sent).value().culling, view.culling);
    for (const double threshold : {0.4, 1.0, 2.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        sent.mutable_culling()->set_threshold(threshold);
        EXPECT_EQ(view_from(sent).error().reason, pb::REASON_INVALID) << threshold;
    }
    sent.mutable_culling()->set_threshold(0.95);
    sent.mutable_culling()->set_kind(static_cast<pb::CullingKind>(4));
    EXPECT_TRUE(view_from(sent).has_error());
}

}  // namespace
}  // namespace shearwater::wire::test
