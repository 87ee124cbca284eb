#pragma once
// A first look at a sub-volume, long before all of it has been read: the voxels at the nodes of one coarse
// level (volume/levels.h), and no others.
//
//   o . . . o . . . o      o  read: rows whose indices are multiples of 2^level, and of them the voxels
//   . . . . . . . . .         whose are
//   . . . . . . . . .      Of a plain file these are a few bytes in thousands, of one that is compressed row
//   by . . . . . . . . .      row as few of its tiles; the rest is not touched. o . . . o . . . o
//
// Nodes are single voxels, where those of a level of detail are means. So their values are distributed as the
// cube's are, and what they add up to along many rays is right; but it is strewn more from ray to ray, and
// what lies between them is not seen.

#include <stop_token>
#include <vector>

#include "common/base/result.h"
#include "common/base/workers.h"
#include "common/volume/box.h"
#include "common/volume/histogram.h"
#include "common/volume/source.h"
#include "renderer/shear/brick_volume.h"

namespace shearwater::shear {

class Sketch {
  public:
    // Reads nodes_kept(box, level, n) of a cube of n voxels, row by row, from a source that gives rows: of
    // another one row would cost as much as many. On all workers at once where the source allows it. Nodes
    // beyond the cube's last voxel are taken from that one. Cancelled between rows; too large from 2^25 nodes
    // on.
    static base::Result<Sketch> read(volume::VoxelSource& source, const volume::Box& box,
                                     const volume::Index3& n, int level, base::Workers& workers,
                                     const std::stop_token& stop = {});

    int level() const { return level_; }
    // Of the nodes that the box owns, as volume::count_values has it: those of a division add up to that of
    // the whole cube's sketch.
    volume::Histogram histogram() const;
    // Codes of the nodes, as the one level of a volume.
    BrickVolume volume(const volume::Mapping& mapping, base::Workers& workers) const;

  private:
    Sketch(const volume::Box& box, const volume::Index3& n, int level);

    volume::Box box_, nodes_;
    volume::Index3 n_;
    int level_;
    std::vector<float> values_;  // of the nodes, axis 0 fastest
};

}  // namespace shearwater::shear
