#include "renderer/shear/micro_layer.h"

#include <algorithm>
#include <array>
#include <bit>

namespace shearwater::shear {

namespace {

// How many bits a byte has: processors that this has to run on may have no instruction for it.
constexpr auto bits_of = [] {
    std::array<std::uint8_t, 256> bits{};
    for (unsigned byte = 0; byte < bits.size(); ++byte) {
        bits[byte] = static_cast<std::uint8_t>(std::popcount(byte));
    }
    return bits;
}();

// A bit for each of a micro-brick's octants in the half nearer to the cube's first plane, by the axis across
// it.
constexpr std::array nearer_octants{0x55U, 0x33U, 0x0fU};

}  // namespace

double distance(const FacePlan& plan, const CodeGrid& grid, int axis, const MicroRun& run) {
    const view::Factorisation& factorisation = plan.factorisation();
    const std::int64_t edge = CodeVolume::octant_edge << plan.level();
    const auto lo = static_cast<double>((2 * grid.first(axis) + run.first) * edge);
    const auto hi = static_cast<double>((2 * grid.first(axis) + run.end) * edge);
    if (factorisation.projection == view::Projection::parallel) {
        return factorisation.direction[axis] < 0 ? -lo : lo;
    }
    return std::max({0.0, lo - factorisation.eye[axis], factorisation.eye[axis] - hi});
}

MicroLayer::MicroLayer(const CodeVolume& codes, std::span<const Content> contents, const FacePlan& plan,
                       std::int64_t layer, const MicroRun& fast, const MicroRun& slow)
    : plan_(plan), grid_(codes.micro_bricks()), first_row_(slow.first) {
    const volume::Index3& counts = grid_.counts();
    const volume::Index3 strides{1, counts[0], counts[0] * counts[1]};
    first_ = contents.data() + layer * strides[static_cast<std::size_t>(plan.face().axis)];
    fast_stride_ = strides[static_cast<std::size_t>(plan.fast_axis())];
    slow_stride_ = strides[static_cast<std::size_t>(plan.slow_axis())];
    rows_.reserve(static_cast<std::size_t>(slow.end - slow.first));
    const int to_far = 1 << plan.face().axis;  // from an octant to the one behind it
    const unsigned near = nearer_octants[static_cast<std::size_t>(plan.face().axis)];
    std::int64_t opaque = 0, blank = 0;
    for (std::int64_t s = slow.first; s < slow.end; ++s) {
        Row row;
        for (std::int64_t f = fast.first; f < fast.end; ++f) {
            const Content& content = at(f, s);
            blank += content.blanks ? 1 : 0;
            if (content.opaque_octants != 0) {
                halves_alike_ = halves_alike_ &&
                                (content.opaque_octants & near) == (content.opaque_octants >> to_far & near);
                opaque += bits_of[content.opaque_octants];
                row.first = row.opaque_octants == 0 ? f : row.first;
                row.end = f + 1;
                row.opaque_octants |= content.opaque_octants;
            }
        }
        rows_.push_back(row);
    }
    const std::int64_t count = (fast.end - fast.first) * (slow.end - slow.first);
    if (opaque > 0) {
        const bool most = 2 * opaque >= 8 * count;
        visit_ = !most ? Visit::parts : blank > 0 ? Visit::with_blanks : Visit::full;
    }
}

void MicroLayer::runs(const MicroRun& fast, std::int64_t slow, int half, std::vector<OctantRun>& out) const {
    // Of a micro-brick's octants the two that the row passes, one after the other.
    const auto near = static_cast<int>(slow % 2 << plan_.slow_axis() | half << plan_.face().axis);
    const int far = near | 1 << plan_.fast_axis();
    const Row& row = rows_[static_cast<std::size_t>(slow / 2 - first_row_)];
    if ((row.opaque_octants & (1U << near | 1U << far)) == 0) {
        out.clear();
        return;
    }
    const auto content_at = [&](std::int64_t f) -> const Content& { return at(f, slow / 2); };
    find_runs(content_at, {row.first, row.end}, fast, near, far, out);
    if (out.size() > 1) {
        const int axis = plan_.fast_axis();
        std::stable_sort(out.begin(), out.end(), [&](const OctantRun& a, const OctantRun& b) {
            return distance(plan_, grid_, axis, a.along) < distance(plan_, grid_, axis, b.along);
        });
    }
}

void front_to_back(const FacePlan& plan, const CodeGrid& grid, int axis, const MicroRun& range,
                   std::vector<std::int64_t>& order) {
    order.clear();
    for (std::int64_t n = range.first; n < range.end; ++n) {
        order.push_back(n);
    }
    const auto distance_of = [&](std::int64_t n) { return distance(plan, grid, axis, {n, n + 1}); };
    // They are in order, this way or that, unless the eye is among them: then one of them is at no distance.
    const double first = distance_of(order.front()), last = distance_of(order.back());
    const bool among = plan.factorisation().projection == view::Projection::perspective &&
                       distance(plan, grid, axis, range) == 0;
    if (among) {
        std::stable_sort(order.begin(), order.end(),
                         [&](std::int64_t a, std::int64_t b) { return distance_of(a) < distance_of(b); });
    } else if (last < first) {
        std::reverse(order.begin(), order.end());
    }
}

}  // namespace shearwater::shear
