#pragma once
// The least extinction that a sample or segment in a cell between nodes may have: a lower bound for every way
// to sample it, along whichever axis, whatever lies between its nodes, and however it is classified.
//
// A segment (shear/segment_table.h) has the mean of the stretches of values that it passes through, which may
// be much shorter than from code to code: that of the thinnest hole counts. A sample has the mean about one
// code, or between two of them, of the same stretches.
//
// Extinctions are whole units, rounded down, of optical depth along the smallest distance of two voxels.

#include <cstdint>
#include <span>
#include <vector>

#include "common/view/transfer_function.h"
#include "common/volume/box.h"
#include "common/volume/mapping.h"
#include "renderer/shear/code_volume.h"

namespace shearwater::culling {

inline constexpr double depth_unit = 1.0 / 4096;
// What is more is opaque enough.
inline constexpr std::int16_t most_units = 32767;

// The least extinction between two codes, of all that interpolation may give.
class LeastExtinctions {
  public:
    // For a mapping's codes, along `length` of the world.
    LeastExtinctions(const view::TransferFunction& tf, const volume::Mapping& mapping, double length);

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
