#pragma once
// Means over the frames of the last two seconds.

#include <deque>

#include "client/model/status.h"
#include "protocol/wire/events.h"

namespace shearwater::model {

class Meter {
  public:
    static constexpr std::chrono::seconds window{2};

    void count(wire::Time now, std::chrono::duration<double> latency, std::size_t bytes);
    Rates rates(wire::Time now) const;

  private:
    struct Entry {
        wire::Time at;
        double latency;
        double bytes;
    };
    std::deque<Entry> entries_;  // the newest always stays: its latency is shown while nothing moves
};

}  // namespace shearwater::model
