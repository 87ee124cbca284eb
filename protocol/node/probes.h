#pragma once
// What children have of single rays, put together: each ray's samples in visibility order, once every child
// that it may meet has given its own, or will not.

#include <chrono>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "protocol/wire/convert_pick.h"
#include "protocol/wire/events.h"

namespace shearwater::node {

class Probes {
  public:
    static constexpr std::size_t most_pending = 256;    // more are cut short, oldest first
    static constexpr std::chrono::seconds patience{5};  // for a child's part of one ray

    // A ray that these children, known by their indices, are asked about. `incomplete`: others should be
    // and cannot.
    void begin(std::uint64_t number, const view::Factorisation& ray, std::set<std::size_t> children,
               bool incomplete, wire::Time now);
    void forget(std::uint64_t number) { pending_.erase(number); }
    void forget_all() { pending_.clear(); }

    // A child's part; of no effect where that is not waited for.
    void answer(std::size_t child, const wire::RayPart& part);
    void child_gone(std::size_t child);
    void tick(wire::Time now);

    std::vector<wire::RayPart> take_complete() { return std::exchange(complete_, {}); }
    std::size_t pending() const { return pending_.size(); }

  private:
    struct Pending {
        wire::RayPart part;
        int sign;  // slices are visited by rising number, or by falling
        std::set<std::size_t> waiting;
        wire::Time since;
    };
    using Entry = std::map<std::uint64_t, Pending>::iterator;

    Entry finish(Entry entry);
    template <class Which>
    void give_up_where(const Which& which);

    std::map<std::uint64_t, Pending> pending_;
    std::vector<wire::RayPart> complete_;
};

}  // namespace shearwater::node
