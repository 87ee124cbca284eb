#pragma once
// The inside of a Hub: the links by their ids, the listeners, and the clock's tick.

#include <boost/asio/ip/tcp.hpp>
#include <map>
#include <set>
#include <vector>

#include "protocol/link/connection.h"
#include "protocol/link/hub.h"

namespace shearwater::link {

struct Hub::State final : Owner, std::enable_shared_from_this<Hub::State> {
    using Acceptor = boost::asio::ip::tcp::acceptor;

    State(boost::asio::io_context& io_, Secret secret_, std::string name_, OnEvent on_event_,
          const Limits& limits_)
        : Owner(std::move(secret_), std::move(name_), limits_),
          io(io_),
          on_event(std::move(on_event_)),
          ticker(io_) {}

    void start();
    base::Result<wire::Address> listen(const wire::Address& address);
    void perform(const wire::Send& send);
    void perform(const wire::CloseLink& close);
    void perform(const wire::Dial& dial);
    void shut_down(std::chrono::milliseconds limit, std::function<void()> when_done);
    void stop();

    void on_up(const std::shared_ptr<Connection>& connection, const Peer& peer) override;
    void on_message(const std::shared_ptr<Connection>& connection, wire::Message message,
                    std::chrono::duration<double> arriving) override;
    void on_end(const std::shared_ptr<Connection>& connection, const wire::Fault& fault) override;
    void on_over(const std::shared_ptr<Connection>& connection) override;

    boost::asio::io_context& io;
    OnEvent on_event;
    OnRefused on_refused_peer;
    std::function<void()> done;  // called once a shutdown is through

  private:
    // running: events and effects flow. ending: goodbyes are being said. ended: nothing happens any more.
    enum class Phase { running, ending, ended };

    static Awaitable<void> tick(std::shared_ptr<State> self);
    static Awaitable<void> accept(std::shared_ptr<State> self, std::shared_ptr<Acceptor> acceptor);
    Awaitable<void> wait_for_room();
    void welcome(boost::asio::ip::tcp::socket socket, const std::string& host);
    std::vector<std::shared_ptr<Connection>> unfinished() const;
    std::size_t accepted() const;
    bool knows(const Connection& connection) const;
    void tell(wire::NetEvent event);
    void end_if_drained();

    boost::asio::steady_timer ticker;
    std::vector<std::shared_ptr<Acceptor>> acceptors;
    std::set<std::shared_ptr<Connection>> live;                   // all of them
    std::map<wire::LinkId, std::shared_ptr<Connection>> by_link;  // those that events and effects speak of
    std::uint64_t next_accepted = wire::first_accepted;

    Phase phase = Phase::running;
    Clock::Time end_by;
};

}  // namespace shearwater::link
