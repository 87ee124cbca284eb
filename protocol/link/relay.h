#pragma once
// Carries bytes between two descriptors of ours and a server on this machine, both ways, until either side
// ends.

#include <boost/asio/io_context.hpp>
#include <memory>
#include <thread>

#include "protocol/wire/events.h"

namespace shearwater::link {

class Relay {
  public:
    // Takes the descriptors over. Runs on a thread of its own.
    Relay(int in, int out, const wire::Address& server);
    ~Relay();
    Relay(const Relay&) = delete;
    Relay& operator=(const Relay&) = delete;

    bool ended() const;

  private:
    struct State;

    boost::asio::io_context io_{1};
    std::unique_ptr<State> state_;
    std::jthread thread_;
};

}  // namespace shearwater::link
