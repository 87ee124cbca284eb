#pragma once
// A leaf's sub-volume as quantised codes: one copy that serves all three principal axes.
//
// Codes lie in rows along axis 0, planes of rows, and so on, as in the cube, so that a tile's samples on a
// slice lie in a few long rows whatever the axis. What a transfer function may pass over is told by bricks of
// 32^3 cells and micro-bricks of 8^3, both on a grid global to the cube, each with the codes that occur on
// its planes, those it shares with its neighbours included.

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "common/base/huge_array.h"
#include "common/base/result.h"
#include "common/base/workers.h"
#include "common/volume/box.h"
#include "common/volume/mapping.h"
#include "common/volume/source.h"

namespace shearwater::shear {

// The codes that occur in a part of the sub-volume.
struct CodeRange {
    std::uint16_t min = 65535;  // of the codes that are not blank; min > max when all are
    std::uint16_t max = 0;
    bool blanks = false;

    bool operator==(const CodeRange&) const = default;
    bool empty() const { return min > max; }
    void add(const CodeRange& other);
};

// A box's cells in cubes on the cube's grid, and what is known of each, axis 0 fastest.
class CodeGrid {
  public:
    CodeGrid() = default;
    CodeGrid(const volume::Box& box, std::int64_t edge);

    std::int64_t edge() const { return edge_; }
    const volume::Index3& counts() const { return counts_; }
    // Of the grid's first along an axis, in edges from the cube's first voxel.
    std::int64_t first(int axis) const { return first_[static_cast<std::size_t>(axis)]; }
    std::size_t index(const volume::Index3& at) const {
        return static_cast<std::size_t>((at[2] * counts_[1] + at[1]) * counts_[0] + at[0]);
    }
    std::span<const CodeRange> ranges() const { return ranges_; }
    std::span<CodeRange> ranges() { return ranges_; }

  private:
    std::int64_t edge_ = 1;
    volume::Index3 first_{}, counts_{};
    std::vector<CodeRange> ranges_;
};

class BrickVolume {
  public:
    static constexpr std::int64_t edge = 32;
    static constexpr std::int64_t micro_edge = 8;

    // Reads the planes of `box` from a source, slab by slab, and quantises them in parallel. Peak memory
    // is the codes and `slab_bytes` of floats. Cancelled between slabs.
    static base::Result<BrickVolume> load(volume::VoxelSource& source, const volume::Box& box,
                                          const volume::Index3& n, const volume::Mapping& mapping,
                                          base::Workers& workers, const volume::Progress& progress = {},
                                          const std::stop_token& stop = {},
                                          std::size_t slab_bytes = std::size_t{32} << 20);

    const volume::Box& box() const { return box_; }
    const volume::Index3& cube() const { return n_; }  // voxels of the whole cube
    const volume::Mapping& mapping() const { return mapping_; }
    std::size_t bytes() const;

    const CodeGrid& bricks() const { return bricks_; }
    const CodeGrid& micro_bricks() const { return micro_bricks_; }

    // The codes, for 8 and for 16 bits; the other is empty. The voxel at p lies at offset(p); from one to the
    // next along an axis it is stride(axis). Behind the last lie voxel_padding bytes more.
    std::span<const std::uint8_t> codes8() const { return codes8_.span(); }
    std::span<const std::uint16_t> codes16() const { return codes16_.span(); }
    std::ptrdiff_t stride(int axis) const { return strides_[static_cast<std::size_t>(axis)]; }
    std::size_t offset(const volume::Index3& p) const;

  private:
    template <class Code>
    base::Status fill(base::HugeArray<Code>& codes, volume::VoxelSource& source, base::Workers& workers,
                      const volume::Progress& progress, const std::stop_token& stop, std::size_t slab_bytes);

    volume::Box box_;
    volume::Index3 n_{};
    volume::Mapping mapping_;
    volume::Index3 strides_{};
    base::HugeArray<std::uint8_t> codes8_;
    base::HugeArray<std::uint16_t> codes16_;
    CodeGrid bricks_, micro_bricks_;
};

}  // namespace shearwater::shear
