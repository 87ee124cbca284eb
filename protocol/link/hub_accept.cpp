// How a hub listens.

#include <algorithm>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/use_awaitable.hpp>

#include "protocol/link/hub_state.h"

namespace shearwater::link {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

// IPv4 first: it is what a bare name's listeners are dialled by.
std::vector<tcp::endpoint> endpoints_of(asio::io_context& io, const wire::Address& address,
                                        boost::system::error_code& error) {
    boost::system::error_code not_numeric;
    const asio::ip::address numeric = asio::ip::make_address(address.host, not_numeric);
    if (!not_numeric) {
        return {tcp::endpoint(numeric, address.port)};
    }
    std::vector<tcp::endpoint> endpoints;
    tcp::resolver resolver(io);
    for (const auto& entry : resolver.resolve(address.host, std::to_string(address.port), error)) {
        endpoints.push_back(entry.endpoint());
    }
    std::ranges::stable_partition(endpoints, [](const tcp::endpoint& e) { return e.address().is_v4(); });
    return endpoints;
}

boost::system::error_code open(tcp::acceptor& acceptor, const tcp::endpoint& endpoint) {
    boost::system::error_code error;
    acceptor.open(endpoint.protocol(), error);
    if (!error) {
        acceptor.set_option(tcp::acceptor::reuse_address(true), error);
        acceptor.bind(endpoint, error);
    }
    if (!error) {
        acceptor.listen(asio::socket_base::max_listen_connections, error);
    }
    return error;
}

// An IPv4 peer of a listener for both is shown as what it is.
std::string host_of(const tcp::endpoint& endpoint) {
    const asio::ip::address address = endpoint.address();
    if (address.is_v6() && address.to_v6().is_v4_mapped()) {
        return asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6()).to_string();
    }
    return address.to_string();
}

}  // namespace

base::Result<wire::Address> Hub::State::listen(const wire::Address& address) {
    boost::system::error_code error = asio::error::host_not_found;
    for (const tcp::endpoint& endpoint : endpoints_of(io, address, error)) {
        const auto acceptor = std::make_shared<Acceptor>(io);
        error = open(*acceptor, endpoint);
        if (!error) {
            const tcp::endpoint bound = acceptor->local_endpoint(error);
            acceptors.push_back(acceptor);
            asio::co_spawn(io, accept(shared_from_this(), acceptor), [](const std::exception_ptr& exception) {
                if (exception) {
                    std::rethrow_exception(exception);
                }
            });
            return wire::Address{bound.address().to_string(), bound.port()};
        }
    }
    return base::error(base::Code::io, "listen on " + wire::to_string(address), error.message());
}

Awaitable<void> Hub::State::accept(std::shared_ptr<State> self, std::shared_ptr<Acceptor> acceptor) {
    while (acceptor->is_open()) {
        co_await self->wait_for_room();
        if (!acceptor->is_open()) {
            break;
        }
        tcp::socket socket(self->io);
        tcp::endpoint peer;
        const auto [error] =
            co_await acceptor->async_accept(socket, peer, asio::as_tuple(asio::use_awaitable));
        if (self->phase != Phase::running) {
            break;
        }
        if (!error) {
            self->welcome(std::move(socket), host_of(peer));
        } else {
            // Out of descriptors, perhaps: others may give some back.
            asio::steady_timer pause(self->io, std::chrono::milliseconds(100));
            co_await pause.async_wait(asio::as_tuple(asio::use_awaitable));
        }
    }
}

std::vector<std::shared_ptr<Connection>> Hub::State::unfinished() const {
    std::vector<std::shared_ptr<Connection>> found;
    std::ranges::copy_if(live, std::back_inserter(found),
                         [](const auto& c) { return c->accepted() && c->link == wire::LinkId{}; });
    return found;
}

std::size_t Hub::State::accepted() const {
    return static_cast<std::size_t>(std::ranges::count_if(live, [](const auto& c) { return c->accepted(); }));
}

// Whoever connects and says nothing must not keep others out for long: while the handshakes are at
// their bound nobody is accepted, and the one that has taken longest has to go if it dawdles.
Awaitable<void> Hub::State::wait_for_room() {
    constexpr std::chrono::milliseconds look_again{20};
    constexpr int dawdling = 10;  // a share of the whole time for a handshake
    asio::steady_timer pause(io);
    while (phase == Phase::running) {
        const auto waiting = unfinished();
        if (waiting.size() < limits.handshakes) {
            co_return;
        }
        const auto oldest = std::ranges::min(waiting, {}, [](const auto& c) { return c->opened(); });
        if (!oldest->opening()) {
            oldest->cut();
        } else if (clock.now() - oldest->opened() > limits.handshake / dawdling) {
            oldest->refuse({wire::pb::REASON_TOO_MANY_LINKS, "others wait for their handshake"});
        }
        pause.expires_after(look_again);
        co_await pause.async_wait(asio::as_tuple(asio::use_awaitable));
    }
}

void Hub::State::welcome(tcp::socket socket, const std::string& host) {
    boost::system::error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    const bool full = accepted() >= limits.links;
    const auto connection = std::make_shared<Connection>(io, shared_from_this());
    live.insert(connection);
    connection->accept(Socket(std::move(socket)), host);
    if (full) {
        connection->refuse(
            {wire::pb::REASON_TOO_MANY_LINKS, "it already has " + std::to_string(limits.links) + " links"});
    }
}

}  // namespace shearwater::link
