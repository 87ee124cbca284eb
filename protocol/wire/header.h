#pragma once
// The fixed header before every message, and what may follow it.
//
//   0        4         6      8             12                20
//   | "SWTR" | version | type | body length | payload length  | body | payload |
//     4 bytes  u16       u16    u32           u64               protobuf  raw
//
// Little-endian. Lengths are checked against the type's limits before anything is allocated.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/result.h"
#include "protocol/wire/message.h"

namespace shearwater::wire {

constexpr std::size_t header_bytes = 20;
// 1 sent windows whole, pixel by pixel; 2 their spans; 3 sent them band by band; 4 knows opacity functions
// and frames of visible blocks only; 5 knows pairs of pictures, crop boxes, points picked and how values lie;
// 6 lets renderers say what is visible; by 7 functions are of cells that the cube's end cuts off, too.
// Nothing else has changed.
constexpr std::uint16_t protocol_version = 7;
constexpr std::uint16_t oldest_version = 7;  // that an open link may have
// Challenge, Hello, Welcome and the goodbyes before a Welcome keep the form of this version for ever, so that
// any two versions can find out what both speak.
constexpr std::uint16_t handshake_version = 1;

struct Limit {
    std::uint32_t body;
    std::uint64_t payload;
};
// Of a type number; null for one we do not know.
const Limit* limit_of(std::uint16_t type);
std::uint16_t type_of(const Body& body);

struct Header {
    std::uint16_t version = 0;
    std::uint16_t type = 0;
    std::uint32_t body = 0;
    std::uint64_t payload = 0;
};

// What is wrong with what a peer sent.
struct Fault {
    pb::Reason reason;
    std::string text;
};
template <class T>
using Parsed = boost::system::result<T, Fault>;
[[noreturn]] void throw_exception_from_error(const Fault& fault, const boost::source_location& where);

Parsed<Header> parse_header(std::span<const std::byte, header_bytes> bytes);
// The body of a header that parse_header accepted. Unknown fields are allowed, a broken body is not.
Parsed<Body> parse_body(const Header& header, std::span<const std::byte> bytes);

// Header and body as bytes; the payload follows as it is. A message of ours over its limit fails a check.
std::vector<std::byte> encode_head(const Message& message, std::uint16_t version = protocol_version);

}  // namespace shearwater::wire
