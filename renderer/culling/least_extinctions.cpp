#include "renderer/culling/least_extinctions.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace shearwater::culling {

using volume::Index3;

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
void least_of(const shear::CodeVolume& nodes, const Index3& first, const LeastExtinctions& extinctions,
              std::span<std::int16_t> units) {
    const Code* at = &nodes.codes<Code>()[nodes.offset(first)];
    const auto row = nodes.stride(1), plane = nodes.stride(2);
    const auto four = [&] {
        const auto [a, b] = std::minmax(at[0], at[row]);
        const auto [c, d] = std::minmax(at[plane], at[row + plane]);
        ++at;
        return std::pair(std::min(a, c), std::max(b, d));
    };
    auto [min, max] = four();
    for (std::int16_t& least : units) {
        const auto [next_min, next_max] = four();
        const Code lowest = std::min(min, next_min);
        least = lowest == 0 ? std::int16_t{0} : extinctions.between(lowest, std::max(max, next_max));
        min = next_min;
        max = next_max;
    }
}

}  // namespace

void least_of_row(const shear::CodeVolume& nodes, const Index3& first, const LeastExtinctions& extinctions,
                  std::span<std::int16_t> units) {
    nodes.bits() == 8 ? least_of<std::uint8_t>(nodes, first, extinctions, units)
                      : least_of<std::uint16_t>(nodes, first, extinctions, units);
}

}  // namespace shearwater::culling
