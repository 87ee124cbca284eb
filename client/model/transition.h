#pragma once
// A jump from one viewpoint to another that takes a moment, so that a person sees where it goes.

#include <chrono>
#include <optional>

#include "client/model/viewpoint.h"
#include "protocol/wire/events.h"

namespace shearwater::model {

class Transition {
  public:
    static constexpr std::chrono::milliseconds length{250};

    // Angles go the shorter way round, the distance by equal factors; the projection changes at once.
    void begin(const Viewpoint& from, const Viewpoint& to, wire::Time now, const view::Lattice& lattice);
    void stop() { jump_.reset(); }
    bool under_way() const { return jump_.has_value(); }
    // Where it goes; null if none is under way.
    const Viewpoint* destination() const { return jump_ ? &jump_->to : nullptr; }

    // Where it has come to, eased in and out; at its end exactly where it goes, and then it is over. Nothing
    // if none is under way.
    std::optional<Viewpoint> at(wire::Time now);

  private:
    struct Jump {
        Viewpoint from, to;
        double from_distance, to_distance;
        wire::Time began;
    };
    std::optional<Jump> jump_;
};

}  // namespace shearwater::model
