#include "common/tree/division.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "common/base/check.h"

namespace shearwater::tree {

namespace {

int axis_to_cut(const volume::Box& box) {
    constexpr std::array by_preference{1, 2, 0};
    return *std::ranges::max_element(by_preference, {}, [&](int axis) { return box.cells(axis); });
}

}  // namespace

base::Result<std::vector<volume::Box>> divide(const volume::Box& box, std::span<const double> weights) {
    base::check(!weights.empty(), "a division has at least one part");
    const int axis = axis_to_cut(box);
    const std::int64_t cells = box.cells(axis);
    const auto parts = static_cast<std::int64_t>(weights.size());
    if (cells < parts) {
        return base::error(base::Code::too_large, "divide " + volume::to_string(box),
                           "its longest axis has " + std::to_string(cells) + " cells, too few for " +
                               std::to_string(parts) + " parts: use a smaller tree");
    }
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<volume::Box> boxes;
    double weight_so_far = 0;
    std::int64_t lo = box.lo[axis];
    for (std::int64_t part = 0; part < parts; ++part) {
        weight_so_far += weights[static_cast<std::size_t>(part)];
        const std::int64_t wanted =
            box.lo[axis] + std::llround(static_cast<double>(cells) * weight_so_far / total);
        // A cell at least for this part and for each that follows.
        const std::int64_t hi = std::clamp(wanted, lo + 1, box.hi[axis] - (parts - 1 - part));
        volume::Box piece = box;
        piece.lo[axis] = lo;
        piece.hi[axis] = part == parts - 1 ? box.hi[axis] : hi;
        boxes.push_back(piece);
        lo = hi;
    }
    return boxes;
}

}  // namespace shearwater::tree
