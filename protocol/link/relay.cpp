#include "protocol/link/relay.h"

#include <array>
#include <atomic>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>

namespace shearwater::link {

namespace asio = boost::asio;
using asio::ip::tcp;

namespace {
constexpr auto awaiting = asio::as_tuple(asio::use_awaitable);
}

struct Relay::State {
    State(asio::io_context& io_in, int in_fd, int out_fd, const wire::Address& address)
        : io(io_in),
          in(io, in_fd),
          out(io, out_fd),
          server(io),
          to(asio::ip::make_address(address.host), address.port) {}

    asio::awaitable<void> connect() {
        const auto [refused] = co_await server.async_connect(to, awaiting);
        if (refused) {
            end();
            co_return;
        }
        boost::system::error_code ignored;
        server.set_option(tcp::no_delay(true), ignored);
        asio::co_spawn(io, carry(in, server), asio::detached);
        asio::co_spawn(io, carry(server, out), asio::detached);
    }

    template <class From, class To>
    asio::awaitable<void> carry(From& from, To& into) {
        std::array<std::byte, 1 << 16> room;
        for (;;) {
            const auto [ended_reading, size] = co_await from.async_read_some(asio::buffer(room), awaiting);
            if (ended_reading) {
                break;
            }
            const auto [ended_writing, written] =
                co_await asio::async_write(into, asio::buffer(room.data(), size), awaiting);
            if (ended_writing) {
                break;
            }
        }
        end();
    }

    void end() {
        boost::system::error_code ignored;
        server.close(ignored);
        in.close(ignored);
        out.close(ignored);
        ended = true;
    }

    asio::io_context& io;
    asio::posix::stream_descriptor in, out;
    tcp::socket server;
    tcp::endpoint to;
    std::atomic<bool> ended = false;
};

Relay::Relay(int in, int out, const wire::Address& server)
    : state_(std::make_unique<State>(io_, in, out, server)) {
    asio::co_spawn(io_, state_->connect(), asio::detached);
    thread_ = std::jthread([this] { io_.run(); });
}

Relay::~Relay() {
    io_.stop();
    thread_.join();
}

bool Relay::ended() const {
    return state_->ended;
}

}  // namespace shearwater::link
