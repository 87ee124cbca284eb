#include "renderer/shear/level_builder.h"

#include <algorithm>
#include <utility>

#include "common/volume/levels.h"
#include "renderer/shear/coarsen.h"

namespace shearwater::shear {

using volume::Box;
using volume::Index3;

namespace {

// Planes of a window that wait for the one that the next coarser node is made from besides.
constexpr std::int64_t waiting = 2;

Box planes_of(Box box, std::int64_t first, std::int64_t end) {
    box.lo[2] = first;
    box.hi[2] = end - 1;
    return box;
}

}  // namespace

LevelBuilder::LevelBuilder(const Box& box, const Index3& n, int bits, std::int64_t planes)
    : n_(n), planes_(planes) {
    std::int64_t passing = planes;
    int level = 0;
    for (const Box& nodes : volume::nodes_to_make(box, n)) {
        const std::int64_t room = std::min(passing + waiting, nodes.planes(2));
        flows_.push_back({.nodes = nodes,
                          .window = CodeVolume(planes_of(nodes, nodes.lo[2], nodes.lo[2] + room), bits),
                          .end = nodes.lo[2]});
        levels_.emplace_back(volume::nodes_kept(box, level++, n), bits);
        passing = room / 2 + 1;
    }
    halo_ = Halo(box, flows_.front().nodes, n);
}

std::optional<Box> LevelBuilder::next() const {
    const Flow& voxels = flows_.front();
    if (voxels.end > voxels.nodes.hi[2]) {
        return std::nullopt;
    }
    return planes_of(voxels.nodes, voxels.end, std::min(voxels.end + planes_, voxels.nodes.hi[2] + 1));
}

// The end of the planes of a level that can be made from what has come of the finer one.
std::int64_t LevelBuilder::ready(std::size_t level) const {
    const Flow& finer = flows_[level - 1];
    const std::int64_t last = volume::last_nodes(n_, static_cast<int>(level) - 1)[2];
    const std::int64_t all = flows_[level].nodes.hi[2] + 1;
    return finer.end > last ? all : std::clamp(finer.end / 2, flows_[level].end, all);
}

// Copies what is kept of the planes of a level from one on.
bool LevelBuilder::keep(std::size_t level, std::int64_t from, base::Workers& workers,
                        const std::stop_token& stop) {
    const Flow& flow = flows_[level];
    CodeVolume& kept = levels_[level];
    const std::int64_t first = std::max(from, kept.box().lo[2]);
    const std::int64_t end = std::min(flow.end, kept.box().hi[2] + 1);
    return first >= end || kept.copy(flow.window, planes_of(kept.box(), first, end), workers, stop);
}

bool LevelBuilder::rise(base::Workers& workers, const std::stop_token& stop) {
    std::int64_t from = flows_.front().end;
    flows_.front().end = next()->hi[2] + 1;
    halo_.add(flows_.front().window, from, flows_.front().end, workers);
    for (std::size_t level = 0; flows_[level].end > from; ++level) {
        Flow& flow = flows_[level];
        if (!keep(level, from, workers, stop)) {
            return false;
        }
        const bool coarsest = level + 1 == flows_.size();
        if (!coarsest) {
            Flow& coarse = flows_[level + 1];
            from = std::exchange(coarse.end, ready(level + 1));
            if (coarse.end > from &&
                !coarsen(flow.window, coarse.window, planes_of(coarse.nodes, from, coarse.end),
                         static_cast<int>(level) + 1, n_, workers, stop)) {
                return false;
            }
        }
        flow.window.move_planes(std::max(flow.end - waiting, flow.nodes.lo[2]));
        if (coarsest) {
            break;
        }
    }
    return true;
}

std::size_t LevelBuilder::bytes() const {
    std::size_t bytes = halo_.bytes();
    for (std::size_t level = 0; level < flows_.size(); ++level) {
        bytes += flows_[level].window.bytes() + levels_[level].bytes();
    }
    return bytes;
}

}  // namespace shearwater::shear
