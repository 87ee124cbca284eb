#include "protocol/link/connection.h"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/use_awaitable.hpp>

#include "common/base/check.h"

namespace shearwater::link {
namespace {

namespace asio = boost::asio;
using wire::Fault;
using wire::Message;
using wire::Parsed;

// For the reader to find the goodbye that came before a connection broke under the writer.
constexpr std::chrono::milliseconds after_broken_write{1000};

// What is left of the parts when so many bytes of them are gone.
std::span<asio::const_buffer> after(std::span<asio::const_buffer> parts, std::size_t gone) {
    while (!parts.empty() && gone >= parts.front().size()) {
        gone -= parts.front().size();
        parts = parts.subspan(1);
    }
    if (!parts.empty()) {
        parts.front() += gone;
    }
    return parts;
}

void rethrow(std::exception_ptr exception) {
    if (exception) {
        std::rethrow_exception(exception);
    }
}

}  // namespace

Connection::Connection(asio::io_context& io, std::shared_ptr<Owner> owner)
    : io_(io),
      owner_(std::move(owner)),
      limits_(owner_->limits),
      socket_(io),
      wake_(io, asio::steady_timer::time_point::max()),
      queue_(limits_) {}

void Connection::accept(Socket socket, std::string peer_host) {
    socket_ = std::move(socket);
    connected_ = true;
    peer_host_ = std::move(peer_host);
    start();
}

void Connection::dial(wire::LinkId to, wire::Route route, pb::Role role) {
    link = to;
    dialled_ = true;
    route_ = std::move(route);
    role_ = role;
    start();
}

void Connection::start() {
    opened_ = heard_ = spoke_ = owner_->clock.now();
    asio::co_spawn(io_, read_side(shared_from_this()), rethrow);
}

void Connection::send(const Message& message) {
    if (phase_ == Phase::up) {
        queue(message);
    }
}

void Connection::queue(const Message& message) {
    if (!queue_.push(message, version_)) {
        finish({pb::REASON_QUEUE_FULL, std::to_string(queue_.messages()) + " messages of " +
                                           std::to_string(queue_.bytes()) + " bytes in all wait for it"});
        return;
    }
    wake_.cancel();
}

void Connection::close(pb::Reason reason, std::string_view text, std::chrono::milliseconds drain) {
    if (phase_ == Phase::closing || phase_ == Phase::over) {
        return;
    }
    const bool was_up = phase_ == Phase::up;
    phase_ = Phase::closing;
    close_by_ = owner_->clock.now() + drain;
    if (was_up) {
        say_goodbye(reason, text);
    } else {
        cut();
    }
}

void Connection::cut() {
    phase_ = Phase::over;
    boost::system::error_code ignored;
    socket_.close(ignored);
    wake_.cancel();
}

void Connection::drop() {
    cut();
    owner_.reset();
}

// The first fault ends the link; whatever follows from it is no news.
void Connection::finish(const Fault& fault) {
    if (phase_ == Phase::closing || phase_ == Phase::over) {
        return;
    }
    phase_ = Phase::closing;
    close_by_ = owner_->clock.now() + limits_.drain;
    queue_.clear();
    const std::shared_ptr<Owner> owner = owner_;
    owner->on_end(shared_from_this(), fault);
    if (!connected_ || broken_ || peer_left_ || fault.reason == pb::REASON_STALLED) {
        cut();
    } else {
        say_goodbye(fault.reason, fault.text);
    }
}

void Connection::say_goodbye(pb::Reason reason, std::string_view text) {
    constexpr std::size_t longest = 1000;
    pb::Goodbye goodbye;
    goodbye.set_reason(reason);
    goodbye.set_text(base::printable(text, longest));
    queue_.push_last(wire::message(std::move(goodbye)), version_);
    wake_.cancel();
}

void Connection::check_deadlines() {
    const Clock::Time now = owner_ ? owner_->clock.now() : Clock::Time{};
    // A command's server may have to be started first, and a person to be asked for a password.
    const auto patience = route_.command.empty() ? limits_.handshake : limits_.command;
    if (phase_ == Phase::opening && now - opened_ > patience) {
        finish(connected_ ? Fault{pb::REASON_TIMED_OUT, "the handshake took too long"}
                          : Fault{pb::REASON_UNREACHABLE, wire::to_string(route_) + ": no answer"});
    } else if (phase_ == Phase::up) {
        check_open_link(now);
    } else if (phase_ == Phase::closing && now > close_by_) {
        cut();
    }
}

void Connection::check_open_link(Clock::Time now) {
    if (broken_ && now - write_broke_ > after_broken_write) {
        finish(lost());
    } else if (now - heard_ > limits_.silence) {
        finish({pb::REASON_TIMED_OUT, "nothing came for " + std::to_string(limits_.silence.count()) + " ms"});
    } else if (writing_ && now - spoke_ > limits_.stall) {
        finish({pb::REASON_STALLED, "it took nothing for " + std::to_string(limits_.stall.count()) + " ms"});
    } else if (!writing_ && queue_.empty() && now - spoke_ > limits_.heartbeat) {
        pb::Ping ping;
        ping.set_token(++pings_);
        queue(wire::message(std::move(ping)));
    }
}

Fault Connection::lost() const {
    if (child_) {
        const std::string words = child_->last_words();
        return {pb::REASON_LOST, words.empty() ? route_.command[0] + " has closed the connection" : words};
    }
    return {pb::REASON_LOST, broken_text_.empty() ? "the other side closed the connection" : broken_text_};
}

Awaitable<void> Connection::read_side(std::shared_ptr<Connection> self) {
    Parsed<void> ready;
    if (self->dialled_) {
        ready = co_await self->connect();
    }
    Parsed<Peer> peer = Peer{};
    if (!ready) {
        peer = ready.error();
    } else {
        asio::co_spawn(self->io_, write_side(self), rethrow);
        peer = co_await self->shake_hands();
    }
    if (!peer) {
        self->finish(peer.error());
    } else if (self->phase_ == Phase::opening) {
        self->phase_ = Phase::up;
        if (self->child_) {
            self->child_->speak_out();
        }
        const std::shared_ptr<Owner> owner = self->owner_;
        owner->on_up(self, *peer);
        co_await self->read_messages();
    }
    co_await self->discard();
    self->cut();
    if (const std::shared_ptr<Owner> owner = self->owner_) {
        owner->on_over(self);
        self->owner_.reset();
    }
}

Awaitable<void> Connection::write_side(std::shared_ptr<Connection> self) {
    boost::system::error_code ignored;
    while (self->phase_ != Phase::over && !self->broken_) {
        const std::vector<Outgoing> batch = self->queue_.pop();
        if (!batch.empty()) {
            self->writing_ = true;
            co_await self->write(batch);
            self->writing_ = false;
        } else if (self->phase_ == Phase::closing) {
            // The reader goes on until the peer has seen the goodbye and closes: closing here, with
            // something unread, would take it back.
            self->socket_.shutdown(Socket::shutdown_send, ignored);
            co_return;
        } else {
            co_await self->wake_.async_wait(asio::as_tuple(asio::use_awaitable));
        }
    }
}

Awaitable<bool> Connection::write(std::span<const Outgoing> batch) {
    spoke_ = owner_ ? owner_->clock.now() : spoke_;
    std::vector<asio::const_buffer> parts;
    for (const Outgoing& outgoing : batch) {
        parts.push_back(asio::buffer(outgoing.head));
        if (outgoing.payload) {
            parts.emplace_back(outgoing.payload->data(), outgoing.payload->size());
        }
    }
    std::span<asio::const_buffer> left = parts;
    while (!left.empty()) {
        const auto [error, written] =
            co_await socket_.async_write_some(left, asio::as_tuple(asio::use_awaitable));
        if (error) {
            broken_ = true;
            broken_text_ = error.message();
            write_broke_ = owner_ ? owner_->clock.now() : write_broke_;
            co_return false;
        }
        left = after(left, written);
        if (owner_) {
            owner_->bytes_sent += written;
            spoke_ = owner_->clock.now();
        }
    }
    co_return true;
}

}  // namespace shearwater::link
