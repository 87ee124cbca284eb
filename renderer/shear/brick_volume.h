#pragma once
// A leaf's sub-volume as quantised bricks: one copy that serves all three principal axes.

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "common/base/result.h"
#include "common/base/workers.h"
#include "common/volume/box.h"
#include "common/volume/mapping.h"
#include "common/volume/source.h"

namespace shearwater::shear {

// A brick owns a cube of at most 32^3 cells (box, half-open, global voxel indices) and stores the planes
// lo to hi of it, axis 0 fastest, so that it can be sampled without its neighbours. Bricks lie on a grid
// global to the cube: a brick's faces are at multiples of 32, or where the sub-volume ends.
struct Brick {
    volume::Box box;
    std::size_t first = 0;  // of its codes in the store
    std::uint16_t min = 0;  // of the codes that are not blank; min > max when all are
    std::uint16_t max = 0;
    bool has_blanks = false;

    bool empty() const { return min > max; }
};

// A brick's cells in cubes of 8^3, 4 x 4 x 4 of them counted from its first cell, axis 0 fastest, each with
// the codes that occur on its planes (the ninth included): what a transfer function may pass over.
struct MicroBricks {
    static constexpr std::int64_t edge = 8;
    static constexpr std::size_t count = 64;

    std::array<std::uint16_t, count> min, max;  // of codes that are not blank; min > max where there are none
};

class BrickVolume {
  public:
    static constexpr std::int64_t edge = 32;

    // Reads the planes of `box` from a source, slab by slab, and quantises them in parallel. Peak memory
    // is the bricks and `slab_bytes` of floats. Cancelled between slabs.
    static base::Result<BrickVolume> load(volume::VoxelSource& source, const volume::Box& box,
                                          const volume::Index3& n, const volume::Mapping& mapping,
                                          base::Workers& workers, const volume::Progress& progress = {},
                                          const std::stop_token& stop = {},
                                          std::size_t slab_bytes = std::size_t{32} << 20);

    const volume::Box& box() const { return box_; }
    const volume::Index3& cube() const { return n_; }  // voxels of the whole cube
    const volume::Mapping& mapping() const { return mapping_; }
    std::size_t bytes() const;

    // Bricks along each axis, and one by its place in the grid.
    const volume::Index3& grid() const { return grid_; }
    const Brick& brick(std::int64_t bx, std::int64_t by, std::int64_t bz) const;
    std::span<const Brick> bricks() const { return bricks_; }
    std::span<const MicroBricks> micro_bricks() const { return micro_bricks_; }  // of each brick

    // The codes, for 8 and for 16 bits; the other is empty. Behind the last lie voxel_padding bytes more.
    std::span<const std::uint8_t> codes8() const { return codes8_; }
    std::span<const std::uint16_t> codes16() const { return codes16_; }

  private:
    base::Status fill_from(volume::VoxelSource& source, base::Workers& workers,
                           const volume::Progress& progress, const std::stop_token& stop,
                           std::size_t slab_bytes);

    volume::Box box_;
    volume::Index3 n_{};
    volume::Index3 grid_{};
    volume::Mapping mapping_;
    std::vector<Brick> bricks_;
    std::vector<MicroBricks> micro_bricks_;
    std::vector<std::uint8_t> codes8_;
    std::vector<std::uint16_t> codes16_;
};

}  // namespace shearwater::shear
