#include "renderer/culling/least_extinctions.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "renderer/shear/opacity_table.h"
#include "renderer/shear/segment_table.h"

namespace shearwater::culling {

using volume::Index3;

LeastExtinctions::LeastExtinctions(const Basis& basis, const volume::Mapping& mapping)
    : log_codes_per_node_(mapping.bits == 8 ? 0 : 4) {
    const view::TransferFunction tf = at_height(basis, least_height);
    const shear::SegmentTable table(tf, mapping.levels(), shear::OpacityTable(tf, mapping.levels()));
    const int last = table.node_of(static_cast<float>(mapping.levels()));
    // The table counts halvings of the light. What a ray gathers is rounded, by less than this.
    constexpr double rounding = 1.0 / 1024;
    const double scale = std::log(2.0) / least_height / value_unit * (1 - rounding);
    std::vector<std::int16_t> stretches;  // from each of the table's nodes to the next, from -1 on
    for (int node = -1; node <= last; ++node) {
        const shear::SegmentTable::Node& from = table.nodes()[node];
        const shear::SegmentTable::Node& to = table.nodes()[node + 1];
        const double halvings = (static_cast<double>(to.depth) - static_cast<double>(from.depth)) +
                                (static_cast<double>(to.depth_rest) - static_cast<double>(from.depth_rest));
        stretches.push_back(static_cast<std::int16_t>(
            std::floor(std::clamp(halvings * scale, 0.0, static_cast<double>(most_units)))));
    }
    // About each node half-way to those beside it: farther than samples and the ends of segments are rounded.
    const int count = (1 << (mapping.bits - log_codes_per_node_)) + 1;
    const int half_way = table.node_of(static_cast<float>(1 << log_codes_per_node_)) / 2;
    least_.emplace_back();
    for (int node = 0; node < count; ++node) {
        const int first = std::clamp((2 * node - 1) * half_way, -1, last);
        const int end = std::clamp((2 * node + 1) * half_way, first + 1, last + 1);
        least_[0].push_back(
            *std::min_element(stretches.begin() + (first + 1), stretches.begin() + (end + 1)));
    }
    for (std::size_t half = 1; 2 * half <= static_cast<std::size_t>(count); half *= 2) {
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
