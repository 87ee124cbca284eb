#include "protocol/wire/header.h"

#include <algorithm>
#include <concepts>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "common/base/check.h"

namespace shearwater::wire {
namespace {

constexpr std::uint32_t kib = 1U << 10;
constexpr std::uint32_t mib = 1U << 20;
constexpr std::array magic{std::byte{'S'}, std::byte{'W'}, std::byte{'T'}, std::byte{'R'}};

// What travels for a body: its number, and how long it may be.
struct Type {
    std::uint16_t number;
    Limit limit;
};
template <class T>
constexpr Type type;

// A number, once given, belongs to its message for ever.
template <>
constexpr Type type<pb::Challenge>{1, {4 * kib, 0}};
template <>
constexpr Type type<pb::Hello>{2, {64 * kib, 0}};
template <>
constexpr Type type<pb::Welcome>{3, {4 * kib, 0}};
template <>
constexpr Type type<pb::Goodbye>{4, {4 * kib, 0}};
template <>
constexpr Type type<pb::Ping>{5, {4 * kib, 0}};
template <>
constexpr Type type<pb::Pong>{6, {4 * kib, 0}};

template <>
constexpr Type type<pb::Join>{16, {mib, 0}};
template <>
constexpr Type type<pb::Assign>{17, {4 * mib, 0}};
template <>
constexpr Type type<pb::Report>{18, {mib, 0}};

template <>
constexpr Type type<pb::Adopt>{32, {mib, 0}};
template <>
constexpr Type type<pb::HistogramReport>{33, {16 * mib, 0}};
template <>
constexpr Type type<pb::SetMapping>{34, {mib, 0}};
template <>
constexpr Type type<pb::NeedVoxels>{35, {mib, 0}};
template <>
constexpr Type type<pb::Voxels>{36, {mib, 64 * mib}};
template <>
constexpr Type type<pb::Render>{37, {256 * kib, 0}};
template <>
constexpr Type type<pb::Cancel>{38, {mib, 0}};
template <>
constexpr Type type<pb::Windows>{39, {mib, 1024 * mib}};  // spans of Factorisation::max_area pixels

template <>
constexpr Type type<pb::WantFunctions>{40, {4 * mib, 0}};
template <>
constexpr Type type<pb::Functions>{41, {mib, 16 * mib}};

template <>
constexpr Type type<pb::GiveFunctions>{42, {mib, 16 * mib}};
template <>
constexpr Type type<pb::Look>{43, {mib, 0}};
template <>
constexpr Type type<pb::Replied>{44, {256 * kib, 0}};

template <>
constexpr Type type<pb::CubeDescription>{64, {mib, 0}};
template <>
constexpr Type type<pb::TreeState>{65, {4 * mib, 0}};
template <>
constexpr Type type<pb::SetView>{66, {mib, 0}};
template <>
constexpr Type type<pb::Frame>{67, {mib, 160 * mib}};  // 2^25 pixels, runs of one included
template <>
constexpr Type type<pb::FrameShown>{68, {mib, 0}};

template <>
constexpr Type type<pb::Pick>{70, {mib, 0}};
template <>
constexpr Type type<pb::Picked>{71, {4 * kib, 0}};
template <>
constexpr Type type<pb::Probe>{72, {256 * kib, 0}};
template <>
constexpr Type type<pb::Probed>{73, {8 * mib, 0}};

// The types and their parsers, in the variant's order.
template <class T>
Parsed<Body> parse_as(std::span<const std::byte> bytes) {
    T body;
    if (!body.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
        return Fault{pb::REASON_MALFORMED, T::descriptor()->name() + ": the body does not parse"};
    }
    return Body(std::move(body));
}
template <class V>
struct Table;
template <class... T>
struct Table<std::variant<T...>> {
    static constexpr std::array types{type<T>...};
    static constexpr std::array parsers{&parse_as<T>...};
};
constexpr auto& types = Table<Body>::types;

constexpr bool numbers_differ() {
    for (std::size_t i = 0; i < types.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (types[i].number == types[j].number) {
                return false;
            }
        }
    }
    return true;
}
static_assert(numbers_differ());

std::size_t index_of(std::uint16_t number) {
    const auto* found = std::ranges::find(types, number, &Type::number);
    return static_cast<std::size_t>(found - types.begin());
}

template <std::unsigned_integral T>
void store(std::byte* to, T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        to[i] = static_cast<std::byte>(value >> (8 * i) & 0xFFU);
    }
}

template <std::unsigned_integral T>
T load(const std::byte* from) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        value |= std::to_integer<std::uint64_t>(from[i]) << (8 * i);
    }
    return static_cast<T>(value);
}

Fault too_large(std::string_view part, std::uint16_t number, std::uint64_t size, std::uint64_t limit) {
    return {pb::REASON_TOO_LARGE, "message type " + std::to_string(number) + ": a " + std::string(part) +
                                      " of " + std::to_string(size) + " bytes, at most " +
                                      std::to_string(limit) + " allowed"};
}

}  // namespace

void throw_exception_from_error(const Fault& fault, const boost::source_location&) {
    throw std::runtime_error(fault.text);
}

const Limit* limit_of(std::uint16_t number) {
    const std::size_t index = index_of(number);
    return index < types.size() ? &types[index].limit : nullptr;
}

std::uint16_t type_of(const Body& body) {
    return types[body.index()].number;
}

Parsed<Header> parse_header(std::span<const std::byte, header_bytes> bytes) {
    if (!std::ranges::equal(bytes.first<magic.size()>(), magic)) {
        return Fault{pb::REASON_BAD_MAGIC, "what came is not a message of this protocol"};
    }
    const std::byte* p = bytes.data() + magic.size();
    const Header header{.version = load<std::uint16_t>(p),
                        .type = load<std::uint16_t>(p + 2),
                        .body = load<std::uint32_t>(p + 4),
                        .payload = load<std::uint64_t>(p + 8)};
    if (header.version < handshake_version || header.version > protocol_version) {
        return Fault{pb::REASON_BAD_VERSION,
                     "a message of protocol version " + std::to_string(header.version)};
    }
    const Limit* limit = limit_of(header.type);
    if (limit == nullptr) {
        return Fault{pb::REASON_BAD_TYPE, "message type " + std::to_string(header.type) + " is unknown"};
    }
    if (header.body > limit->body) {
        return too_large("body", header.type, header.body, limit->body);
    }
    if (header.payload > limit->payload) {
        return too_large("payload", header.type, header.payload, limit->payload);
    }
    return header;
}

Parsed<Body> parse_body(const Header& header, std::span<const std::byte> bytes) {
    const std::size_t index = index_of(header.type);
    base::check(index < types.size() && header.body <= types[index].limit.body, "the header was accepted");
    if (bytes.size() != header.body) {
        return Fault{pb::REASON_MALFORMED, "a body of " + std::to_string(bytes.size()) +
                                               " bytes, the header says " + std::to_string(header.body)};
    }
    return Table<Body>::parsers[index](bytes);
}

std::vector<std::byte> encode_head(const Message& message, std::uint16_t version) {
    const Type& kind = types[message.body.index()];
    const std::size_t body_size =
        std::visit([](const auto& body) { return body.ByteSizeLong(); }, message.body);
    base::check(body_size <= kind.limit.body, "a message's body keeps its limit");
    base::check(message.payload_size() <= kind.limit.payload, "a message's payload keeps its limit");

    std::vector<std::byte> head(header_bytes + body_size);
    std::ranges::copy(magic, head.begin());
    std::byte* p = head.data() + magic.size();
    store(p, version);
    store(p + 2, kind.number);
    store(p + 4, static_cast<std::uint32_t>(body_size));
    store(p + 8, std::uint64_t{message.payload_size()});
    const auto write = [&](const auto& body) {
        return body.SerializeToArray(head.data() + header_bytes, static_cast<int>(body_size));
    };
    base::check(std::visit(write, message.body), "a message serialises");
    return head;
}

}  // namespace shearwater::wire
