#include "renderer/culling/block_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "common/base/check.h"

namespace shearwater::culling {

using volume::Box;

LeastExtinctions::LeastExtinctions(const shear::OpacityTable& table, int bits, double length)
    : log_codes_per_node_(bits == 8 ? 0 : 4) {
    const int nodes = (1 << (bits - log_codes_per_node_)) + 1;
    // The table counts halvings of the light. What a ray gathers is rounded, by less than this.
    constexpr double rounding = 1.0 / 1024;
    const double scale =
        static_cast<double>(table.depth_unit()) * std::log(2.0) * length / depth_unit * (1 - rounding);
    least_.emplace_back();
    for (int node = 0; node < nodes; ++node) {
        const double units = static_cast<double>(table.nodes()[node].extinction) * scale;
        least_[0].push_back(
            static_cast<std::int16_t>(std::floor(std::min(units, static_cast<double>(most_units)))));
    }
    for (std::size_t half = 1; 2 * half <= static_cast<std::size_t>(nodes); half *= 2) {
        const std::vector<std::int16_t>& finer = least_.back();
        std::vector<std::int16_t> least;
        for (std::size_t node = 0; node + half < finer.size(); ++node) {
            least.push_back(std::min(finer[node], finer[node + half]));
        }
        least_.push_back(std::move(least));
    }
}

std::int16_t LeastExtinctions::between(std::uint16_t min, std::uint16_t max) const {
    const std::size_t first = min >> log_codes_per_node_;
    const std::size_t last = (max + (std::size_t{1} << log_codes_per_node_) - 1) >> log_codes_per_node_;
    const std::size_t count = last - first + 1;
    const auto level = static_cast<std::size_t>(std::bit_width(count) - 1);
    return std::min(least_[level][first], least_[level][last + 1 - (std::size_t{1} << level)]);
}

namespace {

template <class Code>
void fill(const shear::CodeVolume& nodes, const Box& box, const LeastExtinctions& extinctions,
          const std::array<int, 3>& counts, std::vector<std::int16_t>& units) {
    const auto length = static_cast<std::size_t>(counts[0]);
    std::vector<Code> least(length + 1), greatest(length + 1);
    std::size_t cell = 0;
    for (int z = 0; z < counts[2]; ++z) {
        for (int y = 0; y < counts[1]; ++y) {
            const Code* const first =
                &nodes.codes<Code>()[nodes.offset({box.lo[0], box.lo[1] + y, box.lo[2] + z})];
            const auto row = nodes.stride(1), plane = nodes.stride(2);
            for (std::size_t x = 0; x <= length; ++x) {
                const Code* const at = first + x;
                const std::array<Code, 4> four{at[0], at[row], at[plane], at[row + plane]};
                least[x] = *std::min_element(four.begin(), four.end());
                greatest[x] = *std::max_element(four.begin(), four.end());
            }
            for (std::size_t x = 0; x < length; ++x) {
                const Code min = std::min(least[x], least[x + 1]);
                units[cell++] = min == 0 ? std::int16_t{0}
                                         : extinctions.between(min, std::max(greatest[x], greatest[x + 1]));
            }
        }
    }
}

}  // namespace

BlockCells::BlockCells(const shear::CodeVolume& nodes, const Box& box, const LeastExtinctions& extinctions) {
    base::check(nodes.box().contains(box), "a block's nodes are held");
    std::size_t cells = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t count = box.cells(axis);
        base::check(0 < count && count <= max_edge, "a block has at most 32 cells a side");
        counts[static_cast<std::size_t>(axis)] = static_cast<int>(count);
        cells *= static_cast<std::size_t>(count);
    }
    units.resize(cells);
    nodes.bits() == 8 ? fill<std::uint8_t>(nodes, box, extinctions, counts, units)
                      : fill<std::uint16_t>(nodes, box, extinctions, counts, units);
    const auto [min, max] = std::minmax_element(units.begin(), units.end());
    least = *min;
    greatest = *max;
}

}  // namespace shearwater::culling
