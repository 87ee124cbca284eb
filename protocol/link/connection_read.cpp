// What a connection does with what comes in.

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>
#include <new>

#include "protocol/link/connection.h"

namespace shearwater::link {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using wire::Fault;
using wire::Message;
using wire::Parsed;

template <class T>
std::uint16_t number_of() {
    return wire::type_of(wire::Body(T()));
}

bool opens_links(std::uint16_t type) {
    return type == number_of<pb::Challenge>() || type == number_of<pb::Hello>() ||
           type == number_of<pb::Welcome>();
}

Fault told_by(const pb::Goodbye& goodbye) {
    const pb::Reason reason = pb::Reason_IsValid(goodbye.reason()) ? goodbye.reason() : pb::REASON_NONE;
    return {reason, goodbye.text().empty() ? std::string(wire::text_of(reason))
                                           : base::printable(goodbye.text(), 1000)};
}

// A peer's length, within its limit, may still be more than there is memory for.
bool grow(base::Buffer& bytes, std::size_t size) {
    try {
        bytes.reserve(size);
        bytes.resize(size);
        return true;
    } catch (const std::bad_alloc&) {
        return false;
    }
}

}  // namespace

Awaitable<Parsed<void>> Connection::connect() {
    const auto unreachable = [this](const std::string& why) {
        return Fault{pb::REASON_UNREACHABLE, wire::to_string(route_) + ": " + why};
    };
    if (!route_.command.empty()) {
        co_return co_await connect_through_command();
    }
    const wire::Address& address = route_.address;
    boost::system::error_code not_numeric;
    const asio::ip::address numeric = asio::ip::make_address(address.host, not_numeric);
    if (!not_numeric) {
        peer_host_ = numeric.to_string();
        co_return co_await connect_to(tcp::endpoint(numeric, address.port));
    }
    tcp::resolver resolver(io_);
    const auto [error, found] = co_await resolver.async_resolve(address.host, std::to_string(address.port),
                                                                asio::as_tuple(asio::use_awaitable));
    if (error) {
        co_return unreachable(error.message());
    }
    Parsed<void> done = unreachable("it has no address");
    for (const auto& entry : found) {
        peer_host_ = entry.endpoint().address().to_string();
        done = co_await connect_to(entry.endpoint());
        if (done || phase_ != Phase::opening) {
            break;
        }
    }
    co_return done;
}

// The far end is told the secret before anything else, where only it can read it: the stream is private.
Awaitable<Parsed<void>> Connection::connect_through_command() {
    auto child = ChildProgram::start(io_, route_.command);
    if (!child) {
        co_return Fault{pb::REASON_UNREACHABLE, child.error().message()};
    }
    child_ = *std::move(child);
    peer_host_ = route_.command[0];
    boost::system::error_code failed;
    socket_.assign(asio::generic::stream_protocol(AF_UNIX, 0), child_->take_stream(), failed);
    if (failed) {
        co_return Fault{pb::REASON_UNREACHABLE, failed.message()};
    }
    connected_ = true;
    const std::string line = owner_->secret.text() + "\n";
    const auto [error, size] =
        co_await asio::async_write(socket_, asio::buffer(line), asio::as_tuple(asio::use_awaitable));
    if (error) {
        co_return lost();
    }
    co_return Parsed<void>();
}

Awaitable<Parsed<void>> Connection::connect_to(asio::generic::stream_protocol::endpoint endpoint) {
    const auto unreachable = [this](const std::string& why) {
        return Fault{pb::REASON_UNREACHABLE, wire::to_string(route_) + ": " + why};
    };
    if (phase_ != Phase::opening) {
        co_return unreachable("given up");
    }
    boost::system::error_code ignored;
    socket_.close(ignored);
    const auto [error] = co_await socket_.async_connect(endpoint, asio::as_tuple(asio::use_awaitable));
    if (error) {
        co_return unreachable(error.message());
    }
    if (phase_ != Phase::opening) {
        co_return unreachable("given up");
    }
    socket_.set_option(tcp::no_delay(true), ignored);
    connected_ = true;
    co_return Parsed<void>();
}

Awaitable<Parsed<Peer>> Connection::shake_hands() {
    if (phase_ != Phase::opening) {
        co_return lost();
    }
    if (dialled_) {
        co_return co_await shake_hands_dialling();
    }
    co_return co_await shake_hands_accepting();
}

Awaitable<Parsed<Peer>> Connection::shake_hands_accepting() {
    const Nonce nonce = random_nonce();
    queue(wire::message(challenge_with(nonce)));
    const Parsed<pb::Hello> hello = co_await expect<pb::Hello>();
    if (!hello) {
        co_return hello.error();
    }
    const Parsed<Admission> admission = admit(*hello, nonce, owner_->secret);
    if (!admission) {
        co_return admission.error();
    }
    queue(wire::message(admission->welcome));
    version_ = admission->version;
    co_return admission->peer;
}

Awaitable<Parsed<Peer>> Connection::shake_hands_dialling() {
    const Parsed<pb::Challenge> challenge = co_await expect<pb::Challenge>();
    if (!challenge) {
        co_return challenge.error();
    }
    const Nonce nonce = random_nonce();
    const Parsed<pb::Hello> hello = answer(*challenge, owner_->secret, role_, owner_->name, nonce);
    if (!hello) {
        co_return hello.error();
    }
    queue(wire::message(*hello));
    const Parsed<pb::Welcome> welcome = co_await expect<pb::Welcome>();
    if (!welcome) {
        co_return welcome.error();
    }
    const Parsed<std::uint16_t> version = verify(*welcome, *challenge, nonce, owner_->secret);
    if (!version) {
        co_return version.error();
    }
    version_ = *version;
    co_return Peer{role_, wire::to_string(route_)};
}

template <class T>
Awaitable<Parsed<T>> Connection::expect() {
    Parsed<Message> message = co_await read_message(number_of<T>());
    if (!message) {
        co_return message.error();
    }
    co_return std::get<T>(std::move(message->body));
}

Awaitable<void> Connection::read_messages() {
    while (phase_ == Phase::up) {
        Parsed<Message> message = co_await read_message(std::nullopt);
        if (!message) {
            finish(message.error());
        } else if (phase_ == Phase::up) {
            handle(std::move(*message));
        }
    }
}

void Connection::handle(Message message) {
    if (const auto* ping = std::get_if<pb::Ping>(&message.body)) {
        pb::Pong pong;
        pong.set_token(ping->token());
        queue(wire::message(std::move(pong)));
    } else if (!std::holds_alternative<pb::Pong>(message.body)) {
        const std::shared_ptr<Owner> owner = owner_;
        owner->on_message(shared_from_this(), std::move(message), arriving_);
    }
}

// After our goodbye: what still comes is let go, until the peer closes or the deadline does.
Awaitable<void> Connection::discard() {
    std::array<std::byte, 4096> scratch;
    while (phase_ == Phase::closing && !broken_) {
        const auto [error, size] =
            co_await socket_.async_read_some(asio::buffer(scratch), asio::as_tuple(asio::use_awaitable));
        if (error) {
            break;
        }
    }
}

Parsed<wire::Header> Connection::accept_header(std::span<const std::byte, wire::header_bytes> bytes,
                                               std::optional<std::uint16_t> expected) const {
    const Parsed<wire::Header> header = wire::parse_header(bytes);
    if (!header) {
        return header;
    }
    const bool fits = expected ? header->type == *expected : !opens_links(header->type);
    if (!fits && header->type != number_of<pb::Goodbye>()) {
        return Fault{pb::REASON_BAD_TYPE,
                     "message type " + std::to_string(header->type) + " is out of place"};
    }
    if (header->version != version_) {
        return Fault{pb::REASON_BAD_VERSION, "a message of version " + std::to_string(header->version) +
                                                 " where another was agreed on"};
    }
    return header;
}

Awaitable<Parsed<Message>> Connection::read_message(std::optional<std::uint16_t> expected) {
    std::array<std::byte, wire::header_bytes> head;
    if (!co_await read_into(head)) {
        co_return lost();
    }
    const Parsed<wire::Header> header = accept_header(head, expected);
    if (!header) {
        co_return header.error();
    }
    const Parsed<base::Buffer> bytes = co_await read_bytes(header->body);
    if (!bytes) {
        co_return bytes.error();
    }
    Parsed<wire::Body> body = wire::parse_body(*header, *bytes);
    if (!body) {
        co_return body.error();
    }
    if (const auto* goodbye = std::get_if<pb::Goodbye>(&*body)) {
        peer_left_ = true;
        co_return told_by(*goodbye);
    }
    Message message{std::move(*body), nullptr};
    arriving_ = {};
    if (header->payload > 0) {
        const auto from = std::chrono::steady_clock::now();
        Parsed<base::Buffer> payload = co_await read_bytes(header->payload);
        if (!payload) {
            co_return payload.error();
        }
        message.payload = std::make_shared<const base::Buffer>(std::move(*payload));
        arriving_ = std::chrono::steady_clock::now() - from;
    }
    co_return message;
}

Awaitable<Parsed<base::Buffer>> Connection::read_bytes(std::uint64_t size) {
    // Memory of a fresh buffer is only addresses until something arrives for it.
    constexpr std::size_t first_step = std::size_t{64} << 20;
    base::Buffer bytes;
    while (bytes.size() < size) {
        const std::size_t arrived = bytes.size();
        const std::size_t step = std::min<std::uint64_t>(size - arrived, std::max(first_step, arrived));
        if (!grow(bytes, arrived + step)) {
            co_return Fault{pb::REASON_TOO_LARGE, "no memory for " + std::to_string(size) + " bytes"};
        }
        if (!co_await read_into(std::span(bytes).subspan(arrived))) {
            co_return lost();
        }
    }
    co_return bytes;
}

std::size_t Connection::take_ahead(std::span<std::byte> to) {
    const std::span<const std::byte> taken = ahead_.first(std::min(to.size(), ahead_.size()));
    std::ranges::copy(taken, to.begin());
    ahead_ = ahead_.subspan(taken.size());
    return taken.size();
}

// Straight to where it belongs, and what comes behind it into the room for that: a small message is one
// read, and several may be.
Awaitable<bool> Connection::read_into(std::span<std::byte> to) {
    to = to.subspan(take_ahead(to));
    while (!to.empty()) {
        const std::array<asio::mutable_buffer, 2> room{asio::buffer(to.data(), to.size()),
                                                       asio::buffer(ahead_room_)};
        const auto [error, size] =
            co_await socket_.async_read_some(room, asio::as_tuple(asio::use_awaitable));
        if (error || phase_ == Phase::closing || phase_ == Phase::over) {
            broken_ = broken_ || error.failed();
            if (error && error != asio::error::eof && broken_text_.empty()) {
                broken_text_ = error.message();
            }
            co_return false;
        }
        const std::size_t here = std::min(size, to.size());
        ahead_ = std::span(ahead_room_).first(size - here);
        to = to.subspan(here);
        owner_->bytes_received += size;
        heard_ = owner_->clock.now();
    }
    co_return true;
}

}  // namespace shearwater::link
