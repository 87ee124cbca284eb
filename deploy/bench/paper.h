#pragma once
// Section 5 of the DVR paper (2003): 2 GHz Pentium 4 machines on Gigabit, random cubes, a flat transfer
// function, all of a 512 x 512 picture covered. Seconds a frame.

#include <array>
#include <cstdint>
#include <optional>

namespace shearwater::bench::paper {

// Table 1: a binary tree of 3, 7, 15 or 31 nodes over a cube of 64 to 1024 voxels an edge.
std::optional<double> tree_seconds(std::int64_t edge, int nodes);

// Table 2: 128^3 by seven nodes into a square picture of 100, 256 or 512 pixels a side.
std::optional<double> image_seconds(int side);

// 2048^3 by one head and 32 renderers.
inline constexpr double large_seconds = 85;
inline constexpr double large_mib_each = 800;

// One processor's rendering core, voxels that all count.
inline constexpr double voxels_per_second = 7e6;

// The paper on plenoptic opacity functions (POF, 2003), section 5: 110592 blocks of 16^3 voxels, 1296
// directions, 32 processors of 1.53 GHz, 4.78 minutes, 55 MB.
inline constexpr double function_processor_ms = 4.78 * 60 * 32 / 110592 * 1e3;
inline constexpr double function_bytes = 55e6 / 110592;
// Its Figure 8: the heights of two bases, and blocks of those not empty.
struct Family {
    double low, high;
    int visible, culled;
};
inline constexpr std::array<Family, 3> families{
    {{0.05, 1.0, 45866, 173}, {0.25, 0.9, 24515, 21524}, {0.80, 0.5, 13458, 32581}}};

}  // namespace shearwater::bench::paper
