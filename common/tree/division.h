#pragma once
// Cutting a box into a junction's shares (DVR 3.2).

#include <span>
#include <vector>

#include "common/base/result.h"
#include "common/volume/box.h"

namespace shearwater::tree {

// Cuts the box along its longest axis into weights.size() boxes in rising order, whose cells are as
// nearly in proportion to the weights (each above 0) as whole cells allow, none without a cell. Of axes as
// long as each other y is cut first, which is upright in most views: those parts lie beside one another in
// the picture, so that little of it comes to the head twice. Then z, and x last: rows stay whole, in files as
// in memory. Neighbours share the plane at the cut. too_large when the axis has fewer cells than there are
// weights.
base::Result<std::vector<volume::Box>> divide(const volume::Box& box, std::span<const double> weights);

}  // namespace shearwater::tree
