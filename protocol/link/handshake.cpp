#include "protocol/link/handshake.h"

#include <algorithm>

namespace shearwater::link {
namespace {

using wire::Fault;
using wire::Parsed;

constexpr std::string_view dial_label = "shearwater dial";
constexpr std::string_view accept_label = "shearwater accept";

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
}

std::string text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool is_known(pb::Role role) {
    return role == pb::ROLE_CLIENT || role == pb::ROLE_RENDERER || role == pb::ROLE_COMPOSITOR ||
           role == pb::ROLE_CHILD;
}

Fault bad_secret() {
    return {pb::REASON_BAD_SECRET, std::string(wire::text_of(pb::REASON_BAD_SECRET))};
}

}  // namespace

Parsed<std::uint16_t> common_version(const VersionRange& ours, const VersionRange& theirs) {
    const std::uint32_t highest = std::min(ours.max, theirs.max);
    if (highest < std::max(ours.min, theirs.min)) {
        return Fault{pb::REASON_BAD_VERSION, "we speak versions " + std::to_string(ours.min) + " to " +
                                                 std::to_string(ours.max) + ", the other side " +
                                                 std::to_string(theirs.min) + " to " +
                                                 std::to_string(theirs.max)};
    }
    return static_cast<std::uint16_t>(highest);
}

pb::Challenge challenge_with(const Nonce& nonce) {
    const VersionRange ours;
    pb::Challenge challenge;
    challenge.set_version_min(ours.min);
    challenge.set_version_max(ours.max);
    challenge.set_nonce(text_of(nonce));
    return challenge;
}

Parsed<pb::Hello> answer(const pb::Challenge& challenge, const Secret& secret, pb::Role role,
                         const std::string& name, const Nonce& nonce) {
    const VersionRange ours;
    const auto version = common_version(ours, {challenge.version_min(), challenge.version_max()});
    if (!version) {
        return version.error();
    }
    if (challenge.nonce().size() != nonce.size()) {
        return Fault{pb::REASON_INVALID, "challenge.nonce: 16 bytes are wanted"};
    }
    pb::Hello hello;
    hello.set_role(role);
    hello.set_version_min(ours.min);
    hello.set_version_max(ours.max);
    hello.set_nonce(text_of(nonce));
    hello.set_proof(text_of(secret.prove(dial_label, bytes_of(challenge.nonce()), nonce)));
    hello.set_name(base::printable(name));
    return hello;
}

Parsed<Admission> admit(const pb::Hello& hello, const Nonce& challenged, const Secret& secret) {
    const auto version = common_version({}, {hello.version_min(), hello.version_max()});
    if (!version) {
        return version.error();
    }
    if (hello.nonce().size() != challenged.size()) {
        return Fault{pb::REASON_INVALID, "hello.nonce: 16 bytes are wanted"};
    }
    const std::span<const std::byte> answered = bytes_of(hello.nonce());
    if (!same(secret.prove(dial_label, challenged, answered), bytes_of(hello.proof()))) {
        return bad_secret();
    }
    if (!is_known(hello.role())) {
        return Fault{pb::REASON_INVALID, "hello.role: unknown"};
    }
    Admission admission{
        .peer = {hello.role(), base::printable(hello.name())}, .version = *version, .welcome = {}};
    admission.welcome.set_version(*version);
    admission.welcome.set_proof(text_of(secret.prove(accept_label, answered, challenged)));
    return admission;
}

Parsed<std::uint16_t> verify(const pb::Welcome& welcome, const pb::Challenge& challenge,
                             const Nonce& answered, const Secret& secret) {
    const auto proof = secret.prove(accept_label, answered, bytes_of(challenge.nonce()));
    if (!same(proof, bytes_of(welcome.proof()))) {
        return bad_secret();
    }
    const auto version = common_version({}, {challenge.version_min(), challenge.version_max()});
    if (!version || welcome.version() != *version) {
        return Fault{pb::REASON_BAD_VERSION, "welcome.version: not the highest that both speak"};
    }
    return *version;
}

}  // namespace shearwater::link
