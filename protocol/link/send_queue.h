#pragma once
// What waits to be written to one link, encoded and bounded.

#include <deque>
#include <vector>

#include "protocol/link/limits.h"
#include "protocol/wire/header.h"

namespace shearwater::link {

struct Outgoing {
    std::uint16_t type = 0;
    std::vector<std::byte> head;  // header and body
    wire::Payload payload;        // null: none

    std::size_t size() const { return head.size() + (payload ? payload->size() : 0); }
};

class SendQueue {
  public:
    explicit SendQueue(const Limits& limits)
        : max_messages_(limits.queued_messages), max_bytes_(limits.queued_bytes) {}

    // Puts a message last. Of SetView and Pong only the newest waits, an older one is dropped; everything
    // else keeps its order. False, and the message is not taken, when a bound would be passed; a message
    // alone in the queue may be of any size.
    bool push(const wire::Message& message, std::uint16_t version);
    // The same for a link's last message, whatever waits.
    void push_last(const wire::Message& message, std::uint16_t version);
    // The first messages, of which one may be large: they leave together. Empty when nothing waits.
    std::vector<Outgoing> pop();
    void clear();

    bool empty() const { return waiting_.empty(); }
    std::size_t messages() const { return waiting_.size(); }
    std::size_t bytes() const { return bytes_; }

  private:
    void append(Outgoing outgoing);
    void drop_older(std::uint16_t type);

    std::size_t max_messages_;
    std::size_t max_bytes_;
    std::deque<Outgoing> waiting_;
    std::size_t bytes_ = 0;
};

}  // namespace shearwater::link
