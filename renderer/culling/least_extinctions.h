#pragma once
// The least extinction that a sample or segment in a cell between nodes may have: a lower bound for every way
// to sample it, along whichever axis, whatever lies between its nodes, and however it is classified.
//
// A segment (shear/segment_table.h) has the mean of the stretches of values that it passes through, which may
// be much shorter than from code to code: that of the thinnest hole counts. A sample has the mean about one
// code, or between two of them, of the same stretches.
//
// Extinctions are whole units, rounded down, of the least height's (common/culling/family.h).

#include <cstdint>
#include <span>
#include <vector>

#include "common/culling/family.h"
#include "common/volume/box.h"
#include "common/volume/mapping.h"
#include "renderer/shear/code_volume.h"

namespace shearwater::culling {

// Of a shape's value. 32 cells of the greatest have a sum that is a word. Nor does a sum of excesses over a
// mean that is cut off at +-2^15 (sheaf.cpp) hide a lack: both together are 2^16 at least only in more cells.
inline constexpr double value_unit = 1.0 / 2040;
inline constexpr std::int16_t most_units = 2040;

// The least extinction between two codes, of all that interpolation may give.
class LeastExtinctions {
  public:
    // Of a basis, for a mapping's codes.
    LeastExtinctions(const Basis& basis, const volume::Mapping& mapping);

    // Codes that are values, min <= max.
    std::int16_t between(std::uint16_t min, std::uint16_t max) const;

  private:
    int log_codes_per_node_;
    std::vector<std::vector<std::int16_t>> least_;  // of 2^k nodes from each on
};

// The least extinctions of the cells of a row along axis 0 from a node on, all between nodes that are held:
// of a cell's eight corners, 0 where one is blank.
void least_of_row(const shear::CodeVolume& nodes, const volume::Index3& first,
                  const LeastExtinctions& extinctions, std::span<std::int16_t> units);

}  // namespace shearwater::culling
