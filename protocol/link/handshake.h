#pragma once
// The handshake's words, without its sockets. The listening side speaks first:
//
//   accepts                               dials
//   Challenge{versions, nonce a}   ->
//                                  <-     Hello{role, versions, nonce d, proof("dial", a, d)}
//   Welcome{version, proof("accept", d, a)}  ->
//
// Either side says Goodbye instead where it refuses the other.

#include "protocol/link/secret.h"
#include "protocol/wire/header.h"

namespace shearwater::link {

namespace pb = wire::pb;

using Nonce = std::array<std::byte, 16>;

struct VersionRange {
    std::uint32_t min = wire::oldest_version;
    std::uint32_t max = wire::protocol_version;
};
// The highest version that both speak.
wire::Parsed<std::uint16_t> common_version(const VersionRange& ours, const VersionRange& theirs);

struct Peer {
    pb::Role role = pb::ROLE_UNKNOWN;
    std::string name;  // printable
};

pb::Challenge challenge_with(const Nonce& nonce);

// The dialling side's answer.
wire::Parsed<pb::Hello> answer(const pb::Challenge& challenge, const Secret& secret, pb::Role role,
                               const std::string& name, const Nonce& nonce);

// The accepting side's judgement of it.
struct Admission {
    Peer peer;
    std::uint16_t version;
    pb::Welcome welcome;
};
wire::Parsed<Admission> admit(const pb::Hello& hello, const Nonce& challenged, const Secret& secret);

// The dialling side's judgement of that: the version to speak.
wire::Parsed<std::uint16_t> verify(const pb::Welcome& welcome, const pb::Challenge& challenge,
                                   const Nonce& answered, const Secret& secret);

}  // namespace shearwater::link
