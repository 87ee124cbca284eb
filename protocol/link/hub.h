#pragma once
// Carries a state machine's effects over TCP and brings it events, all on the thread that runs the
// io_context. One reader and one writer coroutine per link, a deadline by every wait, bounded queues.

#include <boost/asio/io_context.hpp>
#include <functional>
#include <memory>
#include <string>

#include "common/base/result.h"
#include "protocol/link/limits.h"
#include "protocol/link/secret.h"
#include "protocol/wire/events.h"

namespace shearwater::link {

// A peer that never got through its handshake: no link came of it, so no event tells. For logs.
struct Refused {
    std::string peer_host;
    wire::pb::Reason reason;
    std::string text;
};

// To be used from the io_context's thread only, or while nobody runs it.
class Hub {
  public:
    using OnEvent = std::function<void(wire::NetEvent)>;
    using OnRefused = std::function<void(const Refused&)>;

    // `name` is what peers show for us. on_event is called from the io_context's thread only, never
    // from inside perform().
    Hub(boost::asio::io_context& io, Secret secret, std::string name, OnEvent on_event, Limits limits = {});
    ~Hub();  // every link is dropped; no event follows
    Hub(const Hub&) = delete;
    Hub& operator=(const Hub&) = delete;

    // Starts accepting; port 0 takes a free one. Gives the address really bound.
    base::Result<wire::Address> listen(const wire::Address& address);
    void on_refused(OnRefused on_refused);

    // Effects on links that are gone, or not up yet, do nothing; a link that is being dialled can be closed.
    void perform(wire::NetEffect effect);

    // Says goodbye on all links and drains what is queued, for at most `limit`; then calls `done`. No
    // event comes any more, nor does any effect do anything.
    void shut_down(std::chrono::milliseconds limit, std::function<void()> done);

    std::uint64_t bytes_sent() const;
    std::uint64_t bytes_received() const;

  private:
    struct State;
    std::shared_ptr<State> state_;
};

}  // namespace shearwater::link
