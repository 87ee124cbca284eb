// The certifier for whatever vectors the processor has: a row of bundles at a time.

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/culling/certifier.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "renderer/culling/sheaf.h"

#ifndef SHEARWATER_CULLING_CERTIFIER_ROOM
#define SHEARWATER_CULLING_CERTIFIER_ROOM
namespace shearwater::culling {

// Buffers, all of rows of so many bundles along u; beyond a row's last there is room for a vector.
struct Room {
    std::int16_t* row;     // a row of a layer, with most_units on both sides
    std::int16_t* eroded;  // the layer's rows, each bundle with the least of its cells along u
    std::int16_t* excess;  // of each extinction, each row of bundles
    int margin;            // of `row`
    int length;
};

}  // namespace shearwater::culling
#endif

HWY_BEFORE_NAMESPACE();
namespace shearwater::culling::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <std::size_t count>
int first_certain_of(const Layers& cells, const Sheaf& sheaf, const std::int16_t* extinctions,
                     const Room& room) {
    const hn::ScalableTag<std::int16_t> d;
    const auto lanes = static_cast<int>(hn::Lanes(d));
    const int bundles = sheaf.bundles_u.last - sheaf.bundles_u.first + 1;
    const int rows = sheaf.bundles_v.last - sheaf.bundles_v.first + 1;
    const auto zero = hn::Zero(d);
    const std::ptrdiff_t plane = std::ptrdiff_t{room.length} * rows;
    std::fill(room.excess, room.excess + static_cast<std::ptrdiff_t>(count) * plane, std::int16_t{0});
    for (int k = 0; k < sheaf.layers; ++k) {
        const Reach& u = sheaf.u[static_cast<std::size_t>(k)];
        const Reach& v = sheaf.v[static_cast<std::size_t>(k)];
        for (int y = 0; y < cells.counts_v; ++y) {
            const std::int16_t* const from =
                &cells.units[static_cast<std::size_t>((k * cells.counts_v + y) * cells.counts_u)];
            std::copy(from, from + cells.counts_u, room.row + room.margin);
            std::int16_t* const to = room.eroded + y * room.length;
            const std::int16_t* const first = room.row + room.margin + sheaf.bundles_u.first;
            for (int i = 0; i < bundles; i += lanes) {
                auto least = hn::LoadU(d, first + i + u.first);
                for (int x = u.first + 1; x <= u.last; ++x) {
                    least = hn::Min(least, hn::LoadU(d, first + i + x));
                }
                hn::StoreU(least, d, to + i);
            }
        }
        const bool inner = k > 0 && k < sheaf.layers - 1;
        // Bundles surely inside along u.
        const int sure0 = -u.first - sheaf.bundles_u.first;
        const int sure1 = cells.whole_u - u.last - sheaf.bundles_u.first;
        for (int j = 0; j < rows; ++j) {
            const int y0 = j + sheaf.bundles_v.first + v.first, y1 = j + sheaf.bundles_v.first + v.last;
            const int v0 = std::max(y0, 0), v1 = std::min(y1, cells.counts_v - 1);
            if (v0 > v1) {
                continue;
            }
            const bool sure_row = inner && v0 == y0 && y1 < cells.whole_v;
            for (int i = 0; i < bundles; i += lanes) {
                const std::int16_t* at = room.eroded + v0 * room.length + i;
                auto least = hn::LoadU(d, at);
                for (int y = v0 + 1; y <= v1; ++y) {
                    at += room.length;
                    least = hn::Min(least, hn::LoadU(d, at));
                }
                const auto lane = hn::Iota(d, static_cast<std::int16_t>(i));
                const auto sure = hn::And(
                    hn::Gt(lane, hn::Set(d, static_cast<std::int16_t>(sure0 - 1))),
                    hn::Lt(lane, hn::Set(d, sure_row ? static_cast<std::int16_t>(sure1) : std::int16_t{-1})));
                std::int16_t* excess = room.excess + std::ptrdiff_t{j} * room.length + i;
                for (std::size_t n = 0; n < count; ++n, excess += plane) {
                    const auto over = hn::Sub(least, hn::Set(d, extinctions[n]));
                    const auto counted = hn::IfThenElse(sure, over, hn::Min(over, zero));
                    hn::StoreU(hn::SaturatedAdd(hn::LoadU(d, excess), counted), d, excess);
                }
            }
        }
    }
    for (std::size_t n = 0; n < count; ++n) {
        auto least = zero;
        for (int j = 0; j < rows; ++j) {
            const std::int16_t* const excess =
                room.excess + static_cast<std::ptrdiff_t>(n) * plane + std::ptrdiff_t{j} * room.length;
            for (int i = 0; i < bundles; i += lanes) {
                least = hn::Min(least, hn::LoadU(d, excess + i));
            }
        }
        if (hn::AllFalse(d, hn::Lt(least, zero))) {
            return static_cast<int>(n);
        }
    }
    return -1;
}

int first_certain(const Layers& cells, const Sheaf& sheaf, const std::int16_t* extinctions, std::size_t count,
                  const Room& room) {
    switch (count) {
        case 1:
            return first_certain_of<1>(cells, sheaf, extinctions, room);
        case 2:
            return first_certain_of<2>(cells, sheaf, extinctions, room);
        case 3:
            return first_certain_of<3>(cells, sheaf, extinctions, room);
        default:
            return first_certain_of<4>(cells, sheaf, extinctions, room);
    }
}

}  // namespace shearwater::culling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "common/base/check.h"

namespace shearwater::culling {

HWY_EXPORT(first_certain);

int Certifier::first_certain(const Layers& cells, const Sheaf& sheaf,
                             std::span<const std::int16_t> extinctions) {
    base::check(!extinctions.empty() && extinctions.size() <= max_extinctions,
                "one to four extinctions are tried at a time");
    constexpr int widest_vector = 128;  // of any processor, in words
    const int bundles = sheaf.bundles_u.last - sheaf.bundles_u.first + 1;
    const int rows = sheaf.bundles_v.last - sheaf.bundles_v.first + 1;
    // The outermost bundles' cells lie as far beyond the block as those bundles do, in other layers.
    const int margin = 2 * std::max(-sheaf.bundles_u.first, sheaf.bundles_u.last - cells.counts_u + 1);
    const int length = bundles + widest_vector;
    const auto size = [](int n) { return static_cast<std::size_t>(n); };
    row_.assign(size(2 * margin + cells.counts_u + length), most_units);
    eroded_.resize(size(length * cells.counts_v));
    excess_.resize(size(length * rows) * extinctions.size());
    return HWY_DYNAMIC_DISPATCH(first_certain)(
        cells, sheaf, extinctions.data(), extinctions.size(),
        Room{row_.data(), eroded_.data(), excess_.data(), margin, length});
}

}  // namespace shearwater::culling
#endif
