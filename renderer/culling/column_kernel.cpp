#include "renderer/culling/column_kernel.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/culling/column_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shearwater::culling::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int most = 32;  // cells of a block's side
constexpr int most_rows = most + 2 * ColumnSheaf::farthest;

std::uint16_t least_depth(const ColumnCells& cells, const ColumnSheaf& sheaf) {
    const hn::CappedTag<std::uint16_t, most> d;
    const auto lanes = static_cast<int>(hn::Lanes(d));
    alignas(64) std::array<std::uint16_t, most_rows * most> eroded;
    alignas(64) std::array<std::uint16_t, most * most> depths{};
    for (int k = 0; k < sheaf.layers; ++k) {
        const Reach& u = sheaf.u[static_cast<std::size_t>(k)];
        const Reach& v = sheaf.v[static_cast<std::size_t>(k)];
        const int rows = cells.bundles_v + v.last - v.first;
        const std::uint16_t* from = cells.first + k * cells.layer + v.first * cells.row + u.first;
        std::uint16_t* to = eroded.data();
        for (int y = 0; y < rows; ++y, from += cells.row, to += most) {
            for (int i = 0; i < cells.bundles_u; i += lanes) {
                auto least = hn::LoadU(d, from + i);
                for (int x = 1; x <= u.last - u.first; ++x) {
                    least = hn::Min(least, hn::LoadU(d, from + i + x));
                }
                hn::Store(least, d, to + i);
            }
        }
        const int window = v.last - v.first;
        for (int j = 0; j < cells.bundles_v; ++j) {
            for (int i = 0; i < cells.bundles_u; i += lanes) {
                const std::uint16_t* at = eroded.data() + j * most + i;
                auto least = hn::Load(d, at);
                for (int y = 1; y <= window; ++y) {
                    at += most;
                    least = hn::Min(least, hn::Load(d, at));
                }
                std::uint16_t* const depth = depths.data() + j * most + i;
                hn::Store(hn::SaturatedAdd(hn::Load(d, depth), least), d, depth);
            }
        }
    }
    std::uint16_t least = 65535;
    for (int j = 0; j < cells.bundles_v; ++j) {
        const std::uint16_t* const row = depths.data() + j * most;
        least = std::min(least, *std::min_element(row, row + cells.bundles_u));
    }
    return least;
}

}  // namespace shearwater::culling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "common/base/check.h"

namespace shearwater::culling {

HWY_EXPORT(least_depth);

ColumnSheaf::ColumnSheaf(const Slopes& slopes, int first, int count, double middle)
    : first_layer(first), layers(count) {
    base::check(0 < count && count <= max_layers, "a block has 1 to 32 layers");
    for (int layer = 0; layer < count; ++layer) {
        const double near = first + layer - middle;
        u[static_cast<std::size_t>(layer)] = reach_of(slopes.u, near);
        v[static_cast<std::size_t>(layer)] = reach_of(slopes.v, near);
    }
}

std::uint16_t least_depth(const ColumnCells& cells, const ColumnSheaf& sheaf) {
    return HWY_DYNAMIC_DISPATCH(least_depth)(cells, sheaf);
}

std::uint16_t least_depth_by_definition(const ColumnCells& cells, const ColumnSheaf& sheaf) {
    int least = 65535;
    for (int j = 0; j < cells.bundles_v; ++j) {
        for (int i = 0; i < cells.bundles_u; ++i) {
            int depth = 0;
            for (int k = 0; k < sheaf.layers; ++k) {
                const Reach& u = sheaf.u[static_cast<std::size_t>(k)];
                const Reach& v = sheaf.v[static_cast<std::size_t>(k)];
                int in_layer = 65535;
                for (int y = j + v.first; y <= j + v.last; ++y) {
                    for (int x = i + u.first; x <= i + u.last; ++x) {
                        in_layer = std::min<int>(in_layer, cells.first[k * cells.layer + y * cells.row + x]);
                    }
                }
                depth = std::min(depth + in_layer, 65535);
            }
            least = std::min(least, depth);
        }
    }
    return static_cast<std::uint16_t>(least);
}

}  // namespace shearwater::culling
#endif
