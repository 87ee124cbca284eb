#include "renderer/shear/plane_cells.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/shear/plane_cells.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shearwater::shear::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE std::uint64_t little_endian(const std::array<std::uint8_t, sizeof(std::uint64_t)>& bytes) {
    std::uint64_t value = 0;
    for (std::size_t n = 0; n < bytes.size(); ++n) {
        value |= std::uint64_t{bytes[n]} << (8 * n);
    }
    return value;
}

// About those of the first plane whose codes are not less than one and not greater than another.
template <class Code>
HWY_INLINE PlaneNodes nodes_within(const PlaneCodes<Code>& planes, Code least, Code most) {
    const hn::CappedTag<Code, 64> d;
    const auto lanes = static_cast<std::int64_t>(hn::Lanes(d));
    const auto lo = hn::Set(d, least), hi = hn::Set(d, most);
    PlaneNodes nodes;
    for (std::int64_t u = 0; u < planes.across; u += lanes) {
        const auto in_row = hn::FirstN(d, static_cast<std::size_t>(std::min(lanes, planes.across - u)));
        auto columns = hn::FirstN(d, 0);
        const Code* row = planes.voxels + u;
        for (std::int64_t v = 0; v < planes.down; ++v, row += planes.across) {
            const auto codes = hn::LoadU(d, row);
            const auto within = hn::And(in_row, hn::Eq(codes, hn::Min(hn::Max(codes, lo), hi)));
            columns = hn::Or(columns, within);
            if (!hn::AllFalse(d, within)) {
                nodes.slow_first = std::min(nodes.slow_first, v);
                nodes.slow_end = std::max(nodes.slow_end, v + 1);
            }
        }
        std::array<std::uint8_t, sizeof(std::uint64_t)> bits{};
        hn::StoreMaskBits(d, columns, bits.data());
        if (const auto found = little_endian(bits); found != 0) {
            nodes.fast_first = std::min<std::int64_t>(nodes.fast_first, u + std::countr_zero(found));
            nodes.fast_end = u + std::bit_width(found);
        }
    }
    return nodes;
}

PlaneNodes nodes_8(const PlaneCodes<std::uint8_t>& planes, std::uint8_t least, std::uint8_t most) {
    return nodes_within(planes, least, most);
}
PlaneNodes nodes_16(const PlaneCodes<std::uint16_t>& planes, std::uint16_t least, std::uint16_t most) {
    return nodes_within(planes, least, most);
}

}  // namespace
}  // namespace shearwater::shear::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shearwater::shear {

HWY_EXPORT(nodes_8);
HWY_EXPORT(nodes_16);

namespace {

template <class Code>
PlaneNodes nodes_of(const PlaneCodes<Code>& planes, std::int64_t least, std::int64_t most) {
    constexpr std::int64_t greatest = std::numeric_limits<Code>::max();
    if (least <= 0 && most >= greatest) {
        return {0, planes.across, 0, planes.down};
    }
    if (least > greatest || most < 0) {
        return {};
    }
    const auto from = static_cast<Code>(std::max<std::int64_t>(least, 0));
    const auto to = static_cast<Code>(std::min(most, greatest));
    if constexpr (sizeof(Code) == 1) {
        return HWY_DYNAMIC_DISPATCH(nodes_8)(planes, from, to);
    } else {
        return HWY_DYNAMIC_DISPATCH(nodes_16)(planes, from, to);
    }
}

// The cells that have some of these nodes and some of those, or more. Where there is but one node along an
// axis, so is there a cell.
PlaneCells cells_with(const PlaneNodes& these, const PlaneNodes& those, std::int64_t across,
                      std::int64_t down) {
    const auto first = [](std::int64_t a, std::int64_t b) {
        return static_cast<std::uint8_t>(std::clamp<std::int64_t>(std::max(a, b) - 1, 0, 255));
    };
    const auto end = [](std::int64_t a, std::int64_t b, std::int64_t nodes) {
        return static_cast<std::uint8_t>(std::min({a, b, std::max<std::int64_t>(nodes - 1, 1)}));
    };
    return {first(these.fast_first, those.fast_first), end(these.fast_end, those.fast_end, across),
            first(these.slow_first, those.slow_first), end(these.slow_end, those.slow_end, down)};
}

}  // namespace

// A cell may have opacity if it has both a node that is not too low and one that is not too high. Boxes about
// either are found apart: what is in both holds those cells.
template <class Code>
void find_opaque_cells(const PlaneCodes<Code>& planes, const OpacityTable::Codes& opaque,
                       std::span<PlaneCells> cells) {
    PlaneCodes<Code> plane = planes;
    PlaneNodes high_before, low_before;
    for (std::int64_t n = 0; n < planes.count; ++n, plane.voxels += planes.across * planes.down) {
        constexpr std::int64_t greatest = std::numeric_limits<Code>::max();
        const PlaneNodes high = nodes_of(plane, opaque.first, greatest);
        const PlaneNodes low = nodes_of(plane, 0, opaque.last);
        const auto at = static_cast<std::size_t>(2 * n);
        cells[at] = cells_with(high, low, planes.across, planes.down);
        if (n > 0) {
            high_before.add(high);
            low_before.add(low);
            cells[at - 1] = cells_with(high_before, low_before, planes.across, planes.down);
        }
        high_before = high;
        low_before = low;
    }
}

template void find_opaque_cells(const PlaneCodes<std::uint8_t>&, const OpacityTable::Codes&,
                                std::span<PlaneCells>);
template void find_opaque_cells(const PlaneCodes<std::uint16_t>&, const OpacityTable::Codes&,
                                std::span<PlaneCells>);

}  // namespace shearwater::shear
#endif
