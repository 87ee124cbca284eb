#pragma once
// What clients have asked of single points of their pictures: the newest of each counts.

#include <cstdint>
#include <map>
#include <optional>

#include "common/view/ray.h"
#include "protocol/wire/convert_pick.h"
#include "protocol/wire/events.h"

namespace shearwater::head {

class Picks {
  public:
    // A client's pick, and the one of the same client that it replaces.
    struct Begun {
        wire::pb::Probe probe;
        view::Factorisation ray;
        std::optional<std::uint64_t> replaced;
    };
    Begun begin(wire::LinkId client, const wire::PickRequest& pick, const view::Factorisation& ray);
    // The number of a client's, if it has one under way.
    std::optional<std::uint64_t> forget(wire::LinkId client);

    // What all of the tree has of a ray. Unless it is no longer asked for, the client's answer, whose value
    // is still to be read if something is hit.
    struct Answered {
        std::uint64_t number;
        wire::LinkId client;
        wire::PickAnswer answer;
    };
    std::optional<Answered> resolve(const wire::RayPart& part);
    // The value has been read, and the answer can go.
    std::optional<Answered> measured(std::uint64_t number, double value);

  private:
    struct Pick {
        std::uint64_t number = 0;
        view::Factorisation ray;
        wire::PickAnswer answer;
    };
    using Entry = std::map<wire::LinkId, Pick>::iterator;
    Entry find(std::uint64_t number);

    std::map<wire::LinkId, Pick> by_client_;
    std::uint64_t last_number_ = 0;
};

}  // namespace shearwater::head
