#include <vector>

#include "common/view/factorisation.h"

namespace shearwater::view {

namespace {

// What a plane square to `axis` between two boxes, `low` ending at or below where `high` begins, says of
// the rays that cross it: +1 they go from low to high, -1 from high to low, 0 there are none.
int crossing(const Factorisation& factorisation, int axis, std::int64_t low_end, std::int64_t high_begin) {
    if (factorisation.projection == Projection::parallel) {
        const double along = factorisation.direction[axis];
        return along > 0 ? 1 : along < 0 ? -1 : 0;
    }
    const double eye = factorisation.eye[axis];
    // An eye between the two sees each in another half of space.
    const bool from_low = eye < static_cast<double>(high_begin);
    const bool from_high = eye > static_cast<double>(low_end);
    return from_low == from_high ? 0 : from_low ? 1 : -1;
}

// Whether some ray may meet a and later b: no plane between the two forbids it.
bool may_hide(const Factorisation& factorisation, const volume::Box& a, const volume::Box& b) {
    for (int axis = 0; axis < 3; ++axis) {
        if (a.hi[axis] <= b.lo[axis] && crossing(factorisation, axis, a.hi[axis], b.lo[axis]) <= 0) {
            return false;
        }
        if (b.hi[axis] <= a.lo[axis] && crossing(factorisation, axis, b.hi[axis], a.lo[axis]) >= 0) {
            return false;
        }
    }
    return true;
}

}  // namespace

// Boxes made by nested cuts never hide one another in a ring, whatever the eye: the first cut's halves
// are ordered by its plane, and so on inside each. Should a peer's boxes do so, the ring is opened at
// its first box.
std::vector<int> visibility_order(const Factorisation& factorisation, const std::vector<volume::Box>& boxes) {
    const int count = static_cast<int>(boxes.size());
    std::vector<std::vector<int>> hides(boxes.size());
    std::vector<int> hidden_by(boxes.size(), 0);
    for (int a = 0; a < count; ++a) {
        for (int b = 0; b < count; ++b) {
            if (a != b && may_hide(factorisation, boxes[static_cast<std::size_t>(a)],
                                   boxes[static_cast<std::size_t>(b)])) {
                hides[static_cast<std::size_t>(a)].push_back(b);
                ++hidden_by[static_cast<std::size_t>(b)];
            }
        }
    }
    constexpr int placed = -1;
    std::vector<int> order;
    while (static_cast<int>(order.size()) < count) {
        int next = placed;
        for (int box = 0; box < count && (next == placed || hidden_by[static_cast<std::size_t>(next)] > 0);
             ++box) {
            const int waits_for = hidden_by[static_cast<std::size_t>(box)];
            if (waits_for != placed && (next == placed || waits_for == 0)) {
                next = box;
            }
        }
        order.push_back(next);
        hidden_by[static_cast<std::size_t>(next)] = placed;
        for (const int behind : hides[static_cast<std::size_t>(next)]) {
            hidden_by[static_cast<std::size_t>(behind)] -=
                hidden_by[static_cast<std::size_t>(behind)] > 0 ? 1 : 0;
        }
    }
    return order;
}

}  // namespace shearwater::view
