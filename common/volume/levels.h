#pragma once
// The coarser levels of a cube: level L has nodes at the voxel indices that are multiples of 2^L along every
// axis, up to the first that is not before the cube's last voxel. Level 0 is the voxels.
//
//   level 0   o   o   o   o   o   o       a node is made from those of the next finer level that are at most
//             | \ | / | \ | / | \ |       one of its nodes away along every axis
//   level 1   o       o       o       .

#include <vector>

#include "common/volume/box.h"

namespace shearwater::volume {

inline constexpr int max_level = 5;
// The coarsest whose nodes are kept with a margin, as pre-integrated classification needs it: one node more
// of a coarse level takes dozens of voxels more on every side.
inline constexpr int max_margin_level = 2;

// The coarsest that a cube of n voxels has: it has more than 32 nodes along the longest axis, or is level 0.
int coarsest_level(const Index3& n);

// The level of a sketch (renderer/shear/sketch.h) of a cube of n voxels: the finest of at most 2^21 cells,
// those of 128^3, or the coarsest. 0 stands for none: where that is the voxels themselves, which are read as
// fast, and where even the coarsest has more than 2^24 cells.
int sketch_level(const Index3& n);

// A level's last node along each axis.
Index3 last_nodes(const Index3& n, int level);

// The nodes of a level between which the points lie that a box of voxels owns.
Box nodes_of(const Box& box, int level);

// Those and, up to max_margin_level, one more on every side, where the cube has one: between them lie both
// ends of every segment of a ray, from one slice to the next, that begins in the box.
Box nodes_kept(const Box& box, int level, const Index3& n);

// The nodes of the next finer level, with the given last ones, that nodes are made from.
Box made_from(const Box& nodes, const Index3& last_finer);

// Of every level of a cube of n voxels, from 0 to the coarsest, the nodes_kept of a box and those that
// nodes_kept of it on coarser levels are made from. On level 0 it is what whoever renders the box has to
// read.
std::vector<Box> nodes_to_make(const Box& box, const Index3& n);

}  // namespace shearwater::volume
