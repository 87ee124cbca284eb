// The fixed header, its limits, and bodies that are cut or broken.

#include "protocol/wire/header.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "tests/wire/examples.h"

namespace shearwater::wire::test {
namespace {

using Bytes = std::array<std::byte, header_bytes>;

Bytes header_of(std::uint64_t version, std::uint64_t type, std::uint64_t body, std::uint64_t payload) {
    Bytes bytes{std::byte{'S'}, std::byte{'W'}, std::byte{'T'}, std::byte{'R'}};
    std::size_t at = 4;
    const auto put = [&](std::uint64_t value, int count) {
        for (int i = 0; i < count; ++i) {
            bytes[at++] = static_cast<std::byte>(value >> (8 * i));
        }
    };
    put(version, 2);
    put(type, 2);
    put(body, 4);
    put(payload, 8);
    return bytes;
}

struct Expected {
    std::uint16_t number;
    std::uint64_t body;
    std::uint64_t payload;
};
constexpr std::uint64_t kib = 1 << 10;
constexpr std::uint64_t mib = 1 << 20;
// As of version 1. Lines may be added, never changed.
const std::map<std::string, Expected, std::less<>> types{
    {"Challenge", {1, 4 * kib, 0}},
    {"Hello", {2, 64 * kib, 0}},
    {"Welcome", {3, 4 * kib, 0}},
    {"Goodbye", {4, 4 * kib, 0}},
    {"Ping", {5, 4 * kib, 0}},
    {"Pong", {6, 4 * kib, 0}},
    {"Join", {16, mib, 0}},
    {"Assign", {17, 4 * mib, 0}},
    {"Report", {18, mib, 0}},
    {"Adopt", {32, mib, 0}},
    {"HistogramReport", {33, 16 * mib, 0}},
    {"SetMapping", {34, mib, 0}},
    {"NeedVoxels", {35, mib, 0}},
    {"Voxels", {36, mib, 64 * mib}},
    {"Render", {37, 256 * kib, 0}},
    {"Cancel", {38, mib, 0}},
    {"Windows", {39, mib, 1024 * mib}},
    {"WantFunctions", {40, 4 * mib, 0}},
    {"Functions", {41, mib, 16 * mib}},
    {"GiveFunctions", {42, mib, 16 * mib}},
    {"Look", {43, mib, 0}},
    {"Replied", {44, 256 * kib, 0}},
    {"CubeDescription", {64, mib, 0}},
    {"TreeState", {65, 4 * mib, 0}},
    {"SetView", {66, mib, 0}},
    {"Frame", {67, mib, 160 * mib}},
    {"FrameShown", {68, mib, 0}},
    {"Pick", {70, mib, 0}},
    {"Picked", {71, 4 * kib, 0}},
    {"Probe", {72, 256 * kib, 0}},
    {"Probed", {73, 8 * mib, 0}},
};

TEST(Types, HaveTheNumbersAndLimitsOfVersionOne) {
    const std::vector<Message> all = examples();
    ASSERT_EQ(all.size(), std::variant_size_v<Body>);
    ASSERT_EQ(all.size(), types.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i].body.index(), i);
        const Expected& expected = types.at(std::string(name(all[i].body)));
        EXPECT_EQ(type_of(all[i].body), expected.number);
        ASSERT_NE(limit_of(expected.number), nullptr);
        EXPECT_EQ(limit_of(expected.number)->body, expected.body) << name(all[i].body);
        EXPECT_EQ(limit_of(expected.number)->payload, expected.payload) << name(all[i].body);
    }
}

TEST(Types, WithoutAMessageHaveNoLimits) {
    std::size_t known = 0;
    for (std::uint32_t type = 0; type <= 0xFFFF; ++type) {
        known += limit_of(static_cast<std::uint16_t>(type)) != nullptr ? 1U : 0U;
    }
    EXPECT_EQ(known, types.size());
}

TEST(Header, IsLittleEndianInItsOrder) {
    const Header header = parse_header(header_of(1, 39, 0x0A0B0C, 0x0D0E0F10)).value();
    EXPECT_EQ(header.version, 1);
    EXPECT_EQ(header.type, 39);
    EXPECT_EQ(header.body, 0x0A0B0CU);
    EXPECT_EQ(header.payload, 0x0D0E0F10U);
}

TEST(Header, OneOverALimitIsTooLarge) {
    for (const auto& [name, type] : types) {
        EXPECT_TRUE(parse_header(header_of(1, type.number, type.body, type.payload))) << name;
        EXPECT_EQ(parse_header(header_of(1, type.number, type.body + 1, 0)).error().reason,
                  pb::REASON_TOO_LARGE);
        EXPECT_EQ(parse_header(header_of(1, type.number, 0, type.payload + 1)).error().reason,
                  pb::REASON_TOO_LARGE);
        EXPECT_EQ(parse_header(header_of(1, type.number, 0xFFFFFFFF, 0)).error().reason,
                  pb::REASON_TOO_LARGE);
        EXPECT_EQ(parse_header(header_of(1, type.number, 0, std::numeric_limits<std::uint64_t>::max()))
                      .error()
                      .reason,
                  pb::REASON_TOO_LARGE);
    }
}

TEST(Header, OfAnotherMagicVersionOrType) {
    for (std::size_t i = 0; i < 4; ++i) {
        Bytes bytes = header_of(1, 5, 0, 0);
        bytes[i] ^= std::byte{32};
        EXPECT_EQ(parse_header(bytes).error().reason, pb::REASON_BAD_MAGIC);
    }
    for (const std::uint64_t version : {0, protocol_version + 1, 256, 65535}) {
        EXPECT_EQ(parse_header(header_of(version, 5, 0, 0)).error().reason, pb::REASON_BAD_VERSION);
    }
    for (const std::uint64_t type : {0, 7, 15, 45, 69, 256, 65535}) {
        EXPECT_EQ(parse_header(header_of(1, type, 0, 0)).error().reason, pb::REASON_BAD_TYPE);
    }
}

TEST(Body, CutAtEveryByteIsMalformed) {
    for (const Message& example : all_examples()) {
        const std::vector<std::byte> head = encode_head(example);
        const Header header = parse_header(std::span(head).first<header_bytes>()).value();
        const std::span body = std::span(head).subspan(header_bytes);
        ASSERT_TRUE(parse_body(header, body)) << name(example.body);
        for (std::size_t cut = 0; cut < body.size(); ++cut) {
            const auto parsed = parse_body(header, body.first(cut));
            ASSERT_FALSE(parsed) << name(example.body) << " cut at " << cut;
            EXPECT_EQ(parsed.error().reason, pb::REASON_MALFORMED);
        }
    }
}

// What is left may be a message of fewer fields, or none; it is never the whole one.
TEST(Body, CutAtEveryByteWithALengthThatFitsIsAnotherOrMalformed) {
    for (const Message& example : all_examples()) {
        const std::vector<std::byte> head = encode_head(example);
        Header header = parse_header(std::span(head).first<header_bytes>()).value();
        const std::span body = std::span(head).subspan(header_bytes);
        std::size_t malformed = 0;
        for (std::size_t cut = 0; cut < body.size(); ++cut) {
            header.body = static_cast<std::uint32_t>(cut);
            const auto parsed = parse_body(header, body.first(cut));
            malformed += parsed ? 0U : 1U;
            if (parsed) {
                EXPECT_NE(encode_head({*parsed, nullptr}), head);
            }
        }
        EXPECT_GT(malformed, 0U) << name(example.body);
    }
}

TEST(Body, OfUnknownFieldsIsTaken) {
    pb::Cancel body;
    body.set_frame(7);
    std::string text = body.SerializeAsString();
    text += "\xfa\x3f\x03new";  // field 1023, three bytes
    const Header header{
        .version = 1, .type = 38, .body = static_cast<std::uint32_t>(text.size()), .payload = 0};
    EXPECT_EQ(std::get<pb::Cancel>(parse_body(header, std::as_bytes(std::span(text))).value()).frame(), 7U);
}

// File names need not be UTF-8.
TEST(Body, OfTextInNoEncoding) {
    pb::CubeSource cube;
    cube.set_path("/data/caf\xe9.fits");
    pb::Assign body;
    *body.mutable_cube() = cube;
    const std::vector<std::byte> head = encode_head(message(body));
    const Header header = parse_header(std::span(head).first<header_bytes>()).value();
    const Body parsed = parse_body(header, std::span(head).subspan(header_bytes)).value();
    EXPECT_EQ(std::get<pb::Assign>(parsed).cube().path(), cube.path());
}

TEST(EncodeDeathTest, AMessageOfOursOverItsLimitIsOurMistake) {
    pb::Goodbye body;
    body.set_text(std::string(5000, 'x'));
    EXPECT_DEATH(encode_head(message(body)), "body keeps its limit");
    EXPECT_DEATH(encode_head(message(pb::Ping(), std::vector<std::byte>(1))), "payload keeps its limit");
}

TEST(Reasons, AllHaveWords) {
    for (int reason = pb::Reason_MIN; reason <= pb::Reason_MAX; ++reason) {
        EXPECT_NE(text_of(static_cast<pb::Reason>(reason)), "an unknown reason") << reason;
    }
    EXPECT_EQ(text_of(static_cast<pb::Reason>(999)), "an unknown reason");
}

}  // namespace
}  // namespace shearwater::wire::test
