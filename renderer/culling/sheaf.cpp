#include "renderer/culling/sheaf.h"

#include <algorithm>

namespace shearwater::culling {

namespace {

void spread(const Interval& slopes, int layers, std::array<Reach, BlockCells::max_edge>& cells) {
    for (int layer = 0; layer < layers; ++layer) {
        cells[static_cast<std::size_t>(layer)] = reach_of(slopes, layer - layers / 2.0);
    }
}

Reach bundles_of(const std::array<Reach, BlockCells::max_edge>& cells, int layers, int count) {
    Reach bundles{0, count - 1};
    for (int layer = 0; layer < layers; ++layer) {
        const Reach& at = cells[static_cast<std::size_t>(layer)];
        bundles.first = std::min(bundles.first, -at.last);
        bundles.last = std::max(bundles.last, count - 1 - at.first);
    }
    return bundles;
}

}  // namespace

Sheaf::Sheaf(int along, const Slopes& slopes, const std::array<int, 3>& counts)
    : axis(along), layers(counts[static_cast<std::size_t>(along)]) {
    spread(slopes.u, layers, u);
    spread(slopes.v, layers, v);
    bundles_u = bundles_of(u, layers, counts[static_cast<std::size_t>((axis + 1) % 3)]);
    bundles_v = bundles_of(v, layers, counts[static_cast<std::size_t>((axis + 2) % 3)]);
}

Layers::Layers(const BlockCells& cells, int axis) {
    const std::array<std::size_t, 3> strides{
        1, static_cast<std::size_t>(cells.counts[0]),
        static_cast<std::size_t>(cells.counts[0]) * static_cast<std::size_t>(cells.counts[1])};
    const auto u = static_cast<std::size_t>((axis + 1) % 3), v = static_cast<std::size_t>((axis + 2) % 3),
               w = static_cast<std::size_t>(axis);
    counts_u = cells.counts[u];
    counts_v = cells.counts[v];
    whole_u = cells.whole[u];
    whole_v = cells.whole[v];
    units.reserve(cells.units.size());
    for (std::size_t k = 0; k < static_cast<std::size_t>(cells.counts[w]); ++k) {
        for (std::size_t j = 0; j < static_cast<std::size_t>(counts_v); ++j) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(counts_u); ++i) {
                units.push_back(cells.units[k * strides[w] + j * strides[v] + i * strides[u]]);
            }
        }
    }
}

// A bundle's lines have any of their samples that may lie in the block, as long as they have those that
// surely do. Their mean is at least m if the excess over m of the sure ones, and what the others may take
// from it, is not negative.
int first_certain_by_definition(const Layers& cells, const Sheaf& sheaf,
                                std::span<const std::int16_t> extinctions) {
    const auto certain = [&](int m) {
        for (int j = sheaf.bundles_v.first; j <= sheaf.bundles_v.last; ++j) {
            for (int i = sheaf.bundles_u.first; i <= sheaf.bundles_u.last; ++i) {
                int excess = 0;
                for (int k = 0; k < sheaf.layers; ++k) {
                    const Reach& u = sheaf.u[static_cast<std::size_t>(k)];
                    const Reach& v = sheaf.v[static_cast<std::size_t>(k)];
                    const int u0 = std::max(i + u.first, 0), u1 = std::min(i + u.last, cells.counts_u - 1);
                    const int v0 = std::max(j + v.first, 0), v1 = std::min(j + v.last, cells.counts_v - 1);
                    if (u0 > u1 || v0 > v1) {
                        continue;
                    }
                    const bool sure = u0 == i + u.first && i + u.last < cells.whole_u && v0 == j + v.first &&
                                      j + v.last < cells.whole_v && k > 0 && k < sheaf.layers - 1;
                    int least = most_units;
                    for (int y = v0; y <= v1; ++y) {
                        for (int x = u0; x <= u1; ++x) {
                            least = std::min<int>(least, cells.units[static_cast<std::size_t>(
                                                             (k * cells.counts_v + y) * cells.counts_u + x)]);
                        }
                    }
                    excess += sure ? least - m : std::min(least - m, 0);
                    excess = std::clamp(excess, -32768, 32767);
                }
                if (excess < 0) {
                    return false;
                }
            }
        }
        return true;
    };
    for (std::size_t n = 0; n < extinctions.size(); ++n) {
        if (certain(extinctions[n])) {
            return static_cast<int>(n);
        }
    }
    return -1;
}

}  // namespace shearwater::culling
