#pragma once
// A block's cells, each with the least extinction that a sample or segment in it may have: a lower bound for
// every way to sample it, along whichever axis, and whatever lies between its nodes.
//
// Extinctions are whole units, rounded down, of optical depth along the smallest distance of two voxels.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/volume/box.h"
#include "renderer/shear/code_volume.h"
#include "renderer/shear/opacity_table.h"

namespace shearwater::culling {

inline constexpr double depth_unit = 1.0 / 4096;
// What is more is opaque enough.
inline constexpr std::int16_t most_units = 32767;

// The least extinction between two codes, of all that interpolation may give.
class LeastExtinctions {
  public:
    // For codes of so many bits, along `length` of the world.
    LeastExtinctions(const shear::OpacityTable& table, int bits, double length);

    // Codes that are values, min <= max.
    std::int16_t between(std::uint16_t min, std::uint16_t max) const;

  private:
    int log_codes_per_node_;
    std::vector<std::vector<std::int16_t>> least_;  // of 2^k nodes from each on
};

struct BlockCells {
    static constexpr int max_edge = 32;

    std::array<int, 3> counts{};      // along each axis
    std::vector<std::int16_t> units;  // axis 0 fastest; 0 where a corner is blank
    std::int16_t least = 0, greatest = 0;

    // Of the cells between the nodes of a box inside a volume.
    BlockCells(const shear::CodeVolume& nodes, const volume::Box& box, const LeastExtinctions& extinctions);
};

}  // namespace shearwater::culling
