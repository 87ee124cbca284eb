#include "renderer/shear/micro_layer.h"

#include <algorithm>
#include <cmath>

namespace shearwater::shear {

namespace {

// How far a run lies along the rays' way: in perspective all go away from the eye, so runs on one side of it
// are in order of distance, and those on different sides are never on one ray.
double distance(const FacePlan& plan, const CodeGrid& grid, int axis, const MicroRun& run) {
    const view::Factorisation& factorisation = plan.factorisation();
    const std::int64_t edge = grid.edge() << plan.level();
    const auto lo = static_cast<double>((grid.first(axis) + run.first) * edge);
    const auto hi = static_cast<double>((grid.first(axis) + run.end) * edge);
    if (factorisation.projection == view::Projection::parallel) {
        return factorisation.direction[axis] < 0 ? -lo : lo;
    }
    return std::max({0.0, lo - factorisation.eye[axis], factorisation.eye[axis] - hi});
}

}  // namespace

MicroLayer::MicroLayer(const CodeVolume& codes, const Classification& classification, const FacePlan& plan,
                       std::int64_t layer)
    : plan_(plan), grid_(codes.micro_bricks()) {
    const volume::Index3& counts = grid_.counts();
    const volume::Index3 strides{1, counts[0], counts[0] * counts[1]};
    first_ = classification.micro_bricks[static_cast<std::size_t>(plan.level())].data() +
             layer * strides[static_cast<std::size_t>(plan.face().axis)];
    fast_stride_ = strides[static_cast<std::size_t>(plan.fast_axis())];
    slow_stride_ = strides[static_cast<std::size_t>(plan.slow_axis())];
}

bool MicroLayer::uniform(const MicroRun& fast, const MicroRun& slow) const {
    const Content content = at(fast.first, slow.first);
    for (std::int64_t s = slow.first; s < slow.end; ++s) {
        for (std::int64_t f = fast.first; f < fast.end; ++f) {
            if (at(f, s) != content) {
                return false;
            }
        }
    }
    return true;
}

void MicroLayer::runs(const MicroRun& fast, std::int64_t slow, std::vector<Run>& out) const {
    out.clear();
    for (std::int64_t f = fast.first; f < fast.end;) {
        const Content content = at(f, slow);
        std::int64_t end = f + 1;
        while (end < fast.end && at(end, slow) == content) {
            ++end;
        }
        if (content != Content::transparent) {
            out.push_back({{f, end}, content});
        }
        f = end;
    }
    if (out.size() > 1) {
        const int axis = plan_.fast_axis();
        std::stable_sort(out.begin(), out.end(), [&](const Run& a, const Run& b) {
            return distance(plan_, grid_, axis, a.along) < distance(plan_, grid_, axis, b.along);
        });
    }
}

std::vector<std::int64_t> front_to_back(const FacePlan& plan, const CodeGrid& grid, int axis,
                                        const MicroRun& range) {
    std::vector<std::int64_t> order;
    for (std::int64_t n = range.first; n < range.end; ++n) {
        order.push_back(n);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::int64_t a, std::int64_t b) {
        return distance(plan, grid, axis, {a, a + 1}) < distance(plan, grid, axis, {b, b + 1});
    });
    return order;
}

}  // namespace shearwater::shear
