#pragma once
// Carries a state machine's effects over TCP and brings it events, all on the thread that runs the
// io_context. One reader and one writer coroutine per link, a deadline by every wait, bounded queues.

#include <boost/asio/io_context.hpp>
#include <functional>
#include <memory>
#include <string>

#include "common/base/result.h"
#include "protocol/link/secret.h"
#include "protocol/wire/events.h"

namespace shearwater::link {

struct Limits {
    std::chrono::milliseconds handshake{5000};
    std::chrono::milliseconds heartbeat{2000};  // a ping goes out after so much silence of ours
    std::chrono::milliseconds silence{10000};   // and a link is given up after so much of the peer's
    std::chrono::milliseconds stall{30000};     // for one message to leave
    std::size_t queued_messages = 1024;         // more end the link: the peer is too slow
    std::size_t queued_bytes = std::size_t{1} << 30;
    std::size_t links = 256;                    // accepted at a time
};

class Hub {
  public:
    using OnEvent = std::function<void(wire::NetEvent)>;

    // `name` is what peers show for us. on_event is called from the io_context's thread only, never
    // from inside perform().
    Hub(boost::asio::io_context& io, Secret secret, std::string name, OnEvent on_event, Limits limits = {});
    ~Hub();  // every link is dropped; no event follows
    Hub(const Hub&) = delete;
    Hub& operator=(const Hub&) = delete;

    // Starts accepting; port 0 takes a free one. Gives the address really bound.
    base::Result<wire::Address> listen(const wire::Address& address);

    // Effects on links that are gone do nothing.
    void perform(wire::NetEffect effect);

    // Says goodbye on all links and drains what is queued, for at most `limit`; then calls `done`.
    void shut_down(std::chrono::milliseconds limit, std::function<void()> done);

    std::uint64_t bytes_sent() const;
    std::uint64_t bytes_received() const;

  private:
    struct State;
    std::shared_ptr<State> state_;
};

}  // namespace shearwater::link
