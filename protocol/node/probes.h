#pragma once
// What children have of single rays, put together: each ray's samples in visibility order, of every child
// that it may meet.

#include <chrono>
#include <cstdint>
#include <set>
#include <vector>

#include "protocol/node/gathering.h"
#include "protocol/wire/convert_pick.h"
#include "protocol/wire/events.h"

namespace shearwater::node {

class Probes {
  public:
    static constexpr std::size_t most_pending = 256;
    static constexpr std::chrono::seconds patience{5};

    // A ray that these children, known by their indices, are asked about. `incomplete`: others should be
    // and cannot.
    void begin(std::uint64_t number, const view::Factorisation& ray, std::set<std::size_t> children,
               bool incomplete, wire::Time now);
    void forget(std::uint64_t number) { rays_.forget(number); }
    void forget_all() { rays_.forget_all(); }

    // A child's part.
    void answer(std::size_t child, const wire::RayPart& part);
    void child_gone(std::size_t child) { rays_.child_gone(child); }
    void tick(wire::Time now) { rays_.tick(now); }

    std::vector<wire::RayPart> take_complete();
    std::size_t pending() const { return rays_.pending(); }

  private:
    struct Ray : wire::RayPart {
        int sign;  // slices are visited by rising number, or by falling
    };
    Gathering<Ray> rays_{most_pending, patience};
};

}  // namespace shearwater::node
