#pragma once
// What bounds a link's waits and queues.

#include <chrono>
#include <cstddef>

namespace shearwater::link {

struct Limits {
    std::chrono::milliseconds handshake{5000};  // a dial's search for the address and connection included
    std::chrono::milliseconds command{120000};  // the same where a program has to be started for it
    std::chrono::milliseconds heartbeat{2000};  // a ping goes out after so much silence of ours
    std::chrono::milliseconds silence{10000};   // and a link is given up after so much of the peer's
    std::chrono::milliseconds stall{30000};     // while a message leaves: for the next of its bytes to go
    std::chrono::milliseconds drain{5000};      // for a goodbye and what is queued before it
    std::size_t queued_messages = 1024;         // more end the link: the peer is too slow
    std::size_t queued_bytes = std::size_t{1} << 30;
    std::size_t links = 256;      // accepted at a time
    std::size_t handshakes = 32;  // of them not through with their handshake
};

// Time that a link's deadlines are measured in: it stands still while this process does, so that a
// pause of ours is not taken for the peers' silence.
class Clock {
  public:
    using Time = std::chrono::steady_clock::time_point;
    static constexpr std::chrono::milliseconds longest_step{500};

    Time now() const { return now_; }
    void advance() {
        const Time real = std::chrono::steady_clock::now();
        now_ += real - seen_ < longest_step ? real - seen_ : Time::duration(longest_step);
        seen_ = real;
    }

  private:
    Time seen_ = std::chrono::steady_clock::now();
    Time now_ = seen_;
};

}  // namespace shearwater::link
