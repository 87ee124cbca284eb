#pragma once
// Hubs on loopback in one process, and raw sockets to be rude to them with.

#include <gtest/gtest.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <functional>
#include <list>
#include <optional>
#include <thread>

#include "protocol/link/handshake.h"
#include "protocol/link/hub.h"
#include "protocol/wire/header.h"

namespace shearwater::link::test {

namespace asio = boost::asio;
using asio::ip::tcp;
using namespace std::chrono_literals;
using wire::LinkId;

inline Secret secret_of(std::string_view text = "a secret that only tests share") {
    return Secret::from_text(text).value();
}

inline wire::Message cancel(std::uint64_t frame) {
    wire::pb::Cancel body;
    body.set_frame(frame);
    return wire::message(std::move(body));
}

inline wire::Message set_view(std::uint64_t revision) {
    wire::pb::SetView body;
    body.set_revision(revision);
    return wire::message(std::move(body));
}

inline wire::Message windows(std::uint64_t frame, std::size_t payload, std::uint8_t seed = 1) {
    wire::pb::Windows body;
    body.set_frame(frame);
    base::Buffer bytes(payload);
    std::uint32_t state = seed;
    for (std::byte& b : bytes) {
        state = state * 1664525U + 1013904223U;
        b = static_cast<std::byte>(state >> 24);
    }
    return wire::message(std::move(body), std::move(bytes));
}

// Handshakes keep the form of their own version.
inline std::uint16_t version_of(const wire::Message& message) {
    const bool opens = std::holds_alternative<wire::pb::Challenge>(message.body) ||
                       std::holds_alternative<wire::pb::Hello>(message.body) ||
                       std::holds_alternative<wire::pb::Welcome>(message.body);
    return opens ? wire::handshake_version : wire::protocol_version;
}

inline std::vector<std::byte> bytes_of(const wire::Message& message, std::uint16_t version) {
    std::vector<std::byte> bytes = wire::encode_head(message, version);
    if (message.payload) {
        bytes.insert(bytes.end(), message.payload->begin(), message.payload->end());
    }
    return bytes;
}
inline std::vector<std::byte> bytes_of(const wire::Message& message) {
    return bytes_of(message, version_of(message));
}

// A hub that writes down what happens. Ticks are counted only.
struct Station {
    explicit Station(asio::io_context& io, Secret secret = secret_of(), const Limits& limits = {})
        : hub(
              io, std::move(secret), "test station", [this](wire::NetEvent event) { take(std::move(event)); },
              limits) {
        hub.on_refused([this](const Refused& r) { refused.push_back(r); });
    }

    void take(wire::NetEvent event) {
        EXPECT_FALSE(inside_perform) << "an event came from inside perform()";
        if (const auto* up = std::get_if<wire::LinkUp>(&event)) {
            ups.push_back(*up);
        } else if (const auto* down = std::get_if<wire::LinkDown>(&event)) {
            downs.push_back(*down);
        } else if (auto* message = std::get_if<wire::Received>(&event)) {
            received.push_back(std::move(*message));
        } else {
            ++ticks;
        }
        if (then) {
            then();
        }
    }

    wire::Address listen(const std::string& host = "127.0.0.1") { return hub.listen({host, 0}).value(); }

    void perform(wire::NetEffect effect) {
        inside_perform = true;
        hub.perform(std::move(effect));
        inside_perform = false;
    }
    void dial(std::uint64_t link, const wire::Address& to, wire::pb::Role role = wire::pb::ROLE_CLIENT) {
        perform(wire::Dial{LinkId{link}, to, role});
    }
    void send(LinkId link, wire::Message message) { perform(wire::Send{link, std::move(message)}); }

    std::vector<wire::LinkUp> ups;
    std::vector<wire::LinkDown> downs;
    std::vector<wire::Received> received;
    std::vector<Refused> refused;
    std::size_t ticks = 0;
    std::function<void()> then;
    bool inside_perform = false;
    Hub hub;
};

// Runs the loop until the condition holds, for a minute at most.
inline bool run_until(asio::io_context& io, const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) {
            return false;
        }
        io.restart();
        io.run_one_for(50ms);
    }
    return true;
}

inline void run_for(asio::io_context& io, std::chrono::milliseconds time) {
    io.restart();
    io.run_for(time);
}

// A peer that does only what a test says; its reads and writes are awaited by running the same loop.
class Raw {
  public:
    Raw(asio::io_context& io, const wire::Address& to) : io_(io), socket_(io) {
        socket_.connect(tcp::endpoint(asio::ip::make_address(to.host), to.port));
    }
    Raw(asio::io_context& io, tcp::socket socket) : io_(io), socket_(std::move(socket)) {}

    tcp::socket& socket() { return socket_; }

    bool write(std::span<const std::byte> bytes) {
        std::optional<boost::system::error_code> done;
        asio::async_write(socket_, asio::buffer(bytes.data(), bytes.size()),
                          [&](boost::system::error_code error, std::size_t) { done = error; });
        return run_until(io_, [&] { return done.has_value(); }) && !*done;
    }
    bool write(const wire::Message& message) { return write(bytes_of(message)); }

    // False at the end of the connection.
    bool read(std::span<std::byte> to) {
        std::optional<boost::system::error_code> done;
        asio::async_read(socket_, asio::buffer(to.data(), to.size()),
                         [&](boost::system::error_code error, std::size_t) { done = error; });
        return run_until(io_, [&] { return done.has_value(); }) && !*done;
    }
    std::optional<wire::Message> read_message() {
        std::array<std::byte, wire::header_bytes> head;
        if (!read(head)) {
            return std::nullopt;
        }
        const auto header = wire::parse_header(head);
        std::vector<std::byte> body(header.value().body);
        base::Buffer payload(header->payload);
        if (!read(body) || !read(payload)) {
            return std::nullopt;
        }
        wire::Message message{wire::parse_body(*header, body).value(), nullptr};
        message.payload = std::make_shared<const base::Buffer>(std::move(payload));
        return message;
    }
    // The next message of a kind; others, pings say, are passed over.
    template <class T>
    std::optional<T> next() {
        while (auto message = read_message()) {
            if (auto* body = std::get_if<T>(&message->body)) {
                return std::move(*body);
            }
        }
        return std::nullopt;
    }

    // Its side of the handshake, dialling.
    wire::pb::Hello hello(const Secret& secret = secret_of(), wire::pb::Role role = wire::pb::ROLE_CLIENT) {
        const auto challenge = next<wire::pb::Challenge>();
        return answer(challenge.value(), secret, role, "raw", random_nonce()).value();
    }
    bool shake_hands() { return write(wire::message(hello())) && next<wire::pb::Welcome>().has_value(); }

  private:
    asio::io_context& io_;
    tcp::socket socket_;
};

}  // namespace shearwater::link::test
