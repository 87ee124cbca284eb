#pragma once
// Round steps in whatever an axis is measured in.

#include "common/wcs/axis.h"

namespace shearwater::model {

// The least of 1, 2 and 5 times a power of ten that is no less than `least`, which is above 0.
double round_step(double least);

// The same of an axis: on a clock or a circle 1, 2, 5, 10, 15 and 30 seconds and minutes, 1, 2, 3, 6 and 12
// hours, and so on; in the unit of its values.
double world_step(const wcs::Axis& axis, double least);

}  // namespace shearwater::model
