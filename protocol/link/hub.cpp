#include "protocol/link/hub.h"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/use_awaitable.hpp>

#include "common/base/check.h"
#include "protocol/link/hub_state.h"

namespace shearwater::link {
namespace {

namespace asio = boost::asio;
using wire::Fault;
using wire::Message;

constexpr std::chrono::milliseconds tick_period{100};

}  // namespace

Hub::Hub(asio::io_context& io, Secret secret, std::string name, OnEvent on_event, Limits limits)
    : state_(std::make_shared<State>(io, std::move(secret), std::move(name), std::move(on_event), limits)) {
    state_->start();
}

Hub::~Hub() {
    state_->stop();
}

base::Result<wire::Address> Hub::listen(const wire::Address& address) {
    return state_->listen(address);
}

void Hub::on_refused(OnRefused on_refused) {
    state_->on_refused_peer = std::move(on_refused);
}

void Hub::perform(wire::NetEffect effect) {
    std::visit([this](const auto& e) { state_->perform(e); }, effect);
}

void Hub::shut_down(std::chrono::milliseconds limit, std::function<void()> done) {
    state_->shut_down(limit, std::move(done));
}

std::uint64_t Hub::bytes_sent() const {
    return state_->bytes_sent;
}
std::uint64_t Hub::bytes_received() const {
    return state_->bytes_received;
}

void Hub::State::start() {
    asio::co_spawn(io, tick(shared_from_this()), [](const std::exception_ptr& exception) {
        if (exception) {
            std::rethrow_exception(exception);
        }
    });
}

void Hub::State::stop() {
    phase = Phase::ended;
    ticker.cancel();
    boost::system::error_code ignored;
    for (const auto& acceptor : acceptors) {
        acceptor->close(ignored);
    }
    acceptors.clear();
    by_link.clear();
    for (const auto& connection : std::exchange(live, {})) {
        connection->drop();
    }
}

Awaitable<void> Hub::State::tick(std::shared_ptr<State> self) {
    while (self->phase != Phase::ended) {
        self->ticker.expires_after(tick_period);
        co_await self->ticker.async_wait(asio::as_tuple(asio::use_awaitable));
        self->clock.advance();
        for (const auto& connection : std::vector(self->live.begin(), self->live.end())) {
            connection->check_deadlines();
        }
        self->tell(wire::Tick{});
        self->end_if_drained();
    }
}

void Hub::State::tell(wire::NetEvent event) {
    if (phase == Phase::running) {
        on_event(std::move(event));
    }
}

bool Hub::State::knows(const Connection& connection) const {
    const auto found = by_link.find(connection.link);
    return found != by_link.end() && found->second.get() == &connection;
}

void Hub::State::perform(const wire::Send& send) {
    const auto found = by_link.find(send.link);
    if (found != by_link.end()) {
        found->second->send(send.message);
    }
}

void Hub::State::perform(const wire::CloseLink& close) {
    const auto found = by_link.find(close.link);
    if (found != by_link.end()) {
        found->second->close(close.reason, close.text, limits.drain);
        by_link.erase(found);
    }
}

void Hub::State::perform(const wire::Dial& dial) {
    base::check(static_cast<std::uint64_t>(dial.link) < wire::first_accepted && !by_link.contains(dial.link),
                "a dialled link's number is free");
    if (phase == Phase::running) {
        const auto connection = std::make_shared<Connection>(io, shared_from_this());
        live.insert(connection);
        by_link.emplace(dial.link, connection);
        connection->dial(dial.link, dial.route, dial.role);
    }
}

void Hub::State::on_up(const std::shared_ptr<Connection>& connection, const Peer& peer) {
    if (connection->accepted()) {
        connection->link = wire::LinkId{next_accepted++};
        by_link.emplace(connection->link, connection);
    }
    if (knows(*connection)) {
        tell(wire::LinkUp{connection->link, peer.role, peer.name, connection->peer_host()});
    }
}

void Hub::State::on_message(const std::shared_ptr<Connection>& connection, Message message,
                            std::chrono::duration<double> arriving) {
    if (knows(*connection)) {
        tell(wire::Received{connection->link, std::move(message), arriving});
    }
}

// It may be an effect of the machine's that ended the link: the event waits for its turn. In between
// the machine may close the link itself, and then hears no more of it.
void Hub::State::on_end(const std::shared_ptr<Connection>& connection, const Fault& fault) {
    asio::post(io, [self = shared_from_this(), connection, fault] {
        if (self->knows(*connection)) {
            self->by_link.erase(connection->link);
            self->tell(wire::LinkDown{connection->link, fault.reason, fault.text});
        } else if (connection->link == wire::LinkId{} && self->phase == Phase::running &&
                   self->on_refused_peer) {
            self->on_refused_peer({connection->peer_host(), fault.reason, fault.text});
        }
    });
}

void Hub::State::on_over(const std::shared_ptr<Connection>& connection) {
    live.erase(connection);
    end_if_drained();
}

void Hub::State::shut_down(std::chrono::milliseconds limit, std::function<void()> when_done) {
    base::check(phase == Phase::running, "a hub is shut down once");
    phase = Phase::ending;
    done = std::move(when_done);
    end_by = clock.now() + limit;
    boost::system::error_code ignored;
    for (const auto& acceptor : acceptors) {
        acceptor->close(ignored);
    }
    by_link.clear();
    for (const auto& connection : std::vector(live.begin(), live.end())) {
        connection->close(wire::pb::REASON_SHUTDOWN, wire::text_of(wire::pb::REASON_SHUTDOWN), limit);
    }
}

void Hub::State::end_if_drained() {
    if (phase != Phase::ending || (!live.empty() && clock.now() < end_by)) {
        return;
    }
    stop();
    asio::post(io, [self = shared_from_this()] {
        if (const auto when_done = std::exchange(self->done, nullptr)) {
            when_done();
        }
    });
}

}  // namespace shearwater::link
