#include "common/volume/levels.h"

#include <algorithm>

namespace shearwater::volume {

namespace {

std::int64_t rounded_up(std::int64_t voxel, int level) {
    return (voxel + (std::int64_t{1} << level) - 1) >> level;
}

}  // namespace

int coarsest_level(const Index3& n) {
    constexpr std::int64_t fewest_cells = 32;
    const std::int64_t last = *std::max_element(n.begin(), n.end()) - 1;
    int level = 0;
    while (level < max_level && rounded_up(last, level + 1) >= fewest_cells) {
        ++level;
    }
    return level;
}

int sketch_level(const Index3& n) {
    constexpr double enough_cells = 1 << 21, most_cells = 1 << 24;
    const auto cells = [&](int level) {
        const Index3 last = last_nodes(n, level);
        return static_cast<double>(last[0]) * static_cast<double>(last[1]) * static_cast<double>(last[2]);
    };
    int level = 0;
    while (level < coarsest_level(n) && cells(level) > enough_cells) {
        ++level;
    }
    return cells(level) > most_cells ? 0 : level;
}

Index3 last_nodes(const Index3& n, int level) {
    return {rounded_up(n[0] - 1, level), rounded_up(n[1] - 1, level), rounded_up(n[2] - 1, level)};
}

Box nodes_of(const Box& box, int level) {
    Box nodes;
    for (std::size_t a = 0; a < 3; ++a) {
        nodes.lo[a] = box.lo[a] >> level;
        nodes.hi[a] = rounded_up(box.hi[a], level);
    }
    return nodes;
}

Box nodes_kept(const Box& box, int level, const Index3& n) {
    Box nodes = nodes_of(box, level);
    if (level > max_margin_level) {
        return nodes;
    }
    const Index3 last = last_nodes(n, level);
    for (std::size_t a = 0; a < 3; ++a) {
        nodes.lo[a] = std::max<std::int64_t>(nodes.lo[a] - 1, 0);
        nodes.hi[a] = std::min(nodes.hi[a] + 1, last[a]);
    }
    return nodes;
}

Box made_from(const Box& nodes, const Index3& last_finer) {
    Box finer;
    for (std::size_t a = 0; a < 3; ++a) {
        finer.lo[a] = std::max<std::int64_t>(2 * nodes.lo[a] - 1, 0);
        finer.hi[a] = std::min(2 * nodes.hi[a] + 1, last_finer[a]);
    }
    return finer;
}

std::vector<Box> nodes_to_make(const Box& box, const Index3& n) {
    std::vector<Box> levels;
    for (int level = 0; level <= coarsest_level(n); ++level) {
        levels.push_back(nodes_kept(box, level, n));
    }
    for (std::size_t level = levels.size() - 1; level > 0; --level) {
        const Box needed = made_from(levels[level], last_nodes(n, static_cast<int>(level) - 1));
        Box& finer = levels[level - 1];
        for (std::size_t a = 0; a < 3; ++a) {
            finer.lo[a] = std::min(finer.lo[a], needed.lo[a]);
            finer.hi[a] = std::max(finer.hi[a], needed.hi[a]);
        }
    }
    return levels;
}

}  // namespace shearwater::volume
