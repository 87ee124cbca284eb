#pragma once
// What passes between a daemon's state machine and the network, so that the machine knows no sockets:
// events in, effects out. protocol/link carries the effects out over TCP; a test may carry them itself.

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/wire/message.h"

namespace shearwater::wire {

// A link as its machine knows it. Dialled links are numbered by the machine, from 1; accepted ones by
// whoever carries the links, from first_accepted.
enum class LinkId : std::uint64_t {};
constexpr std::uint64_t first_accepted = std::uint64_t{1} << 32;

struct Address {
    std::string host;
    std::uint16_t port = 0;
    bool operator==(const Address&) const = default;
};
std::string to_string(const Address& address);  // "host:port", "[::1]:port"
// "host", "host:port", "[::1]", "[::1]:port" or "::1"; the default port where none is given.
base::Result<Address> parse_address(std::string_view text, std::uint16_t default_port);

// How a server is reached: at an address, or, where there is a command, through the standard streams of the
// program that it starts.
struct Route {
    Route() = default;
    Route(Address to) : address(std::move(to)) {}
    explicit Route(std::vector<std::string> through) : command(std::move(through)) {}

    Address address;
    std::vector<std::string> command;
    bool operator==(const Route&) const = default;
};
std::string to_string(const Route& route);  // "host:port"; a command's words

// Time as the machines see it: it is handed in.
using Time = std::chrono::steady_clock::time_point;

// ---- events ----
struct LinkUp {  // the handshake is done
    LinkId link;
    pb::Role role;          // accepted: what the peer said it is; dialled: what we said
    std::string peer_name;  // printable
    std::string peer_host;  // numeric address
};
struct Received {
    LinkId link;
    Message message;  // never Challenge, Hello, Welcome, Ping or Pong: links see to those
    std::chrono::duration<double>
        arriving{};  // its payload's time on the way, from its first byte to the last
};
struct LinkDown {  // also when a dial came to nothing
    LinkId link;
    pb::Reason reason;
    std::string text;
};
struct Tick {};  // some ten times a second
using NetEvent = std::variant<LinkUp, Received, LinkDown, Tick>;

// ---- effects ----
struct Send {
    LinkId link;
    Message message;
};
struct CloseLink {  // says goodbye first; no LinkDown follows
    LinkId link;
    pb::Reason reason;
    std::string text;
};
struct Dial {
    LinkId link;
    Route route;
    pb::Role role;
};
using NetEffect = std::variant<Send, CloseLink, Dial>;

}  // namespace shearwater::wire
