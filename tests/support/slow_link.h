#pragma once
// A link of a given speed and delay between a client and a server on this machine.

#include <boost/asio/io_context.hpp>
#include <chrono>
#include <memory>
#include <thread>

#include "protocol/wire/events.h"

namespace shearwater::test {

struct LinkShape {
    double bytes_per_second;                  // each way
    std::chrono::duration<double> one_way{};  // from a byte's departure to its arrival
};

// Listens on loopback, dials the server for each client, and carries bytes between them on a thread of its
// own, in order, as a link of that shape would; as much is under way as such a link holds, and a router's
// buffer before it.
class SlowLink {
  public:
    SlowLink(const wire::Address& server, const LinkShape& shape);
    ~SlowLink();
    SlowLink(const SlowLink&) = delete;
    SlowLink& operator=(const SlowLink&) = delete;

    const wire::Address& address() const { return address_; }

  private:
    struct Carrier;

    boost::asio::io_context io_{1};
    std::unique_ptr<Carrier> carrier_;
    wire::Address address_;
    std::jthread thread_;
};

}  // namespace shearwater::test
