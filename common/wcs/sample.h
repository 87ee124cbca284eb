#pragma once
// Makes the grid of an axis from whatever formulas its values come from.

#include <functional>
#include <span>

#include "common/wcs/axis.h"

namespace shearwater::wcs {

// A value for each place; not a number where there is none.
using Formula = std::function<std::vector<double>(std::span<const Place>)>;

// Fills in the nodes of an axis along one of a cube's, as few as give the formula within a fiftieth of what a
// voxel makes, or as many as there may be. False where the formula does not change along the axis or has no
// values; the axis is then as it was.
bool sample(Axis& axis, int along, const volume::Index3& n, const Formula& formula);

}  // namespace shearwater::wcs
